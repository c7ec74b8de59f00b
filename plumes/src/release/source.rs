//! A source of odour: where it is, how much it releases, and in what portions.
//!
//! *Source*: Farrell, Murlis, Long, Li & Cardé 2002, Environ. Fluid Mech. 2, 143 (release and growth of filaments).
//!
//! *Parameters*: `rate_g_s` mass released (g/s); `release.rate_hz` filaments per second (1/s; 5 to 10);
//! `release.initial_size_m` R0 (m; √0.001); `release.growth_m2_s` γ (m²/s; 0.001); `release.vertical_size_limit_m`
//! greatest vertical size (m; none); `release.structure` (0), see the filaments' `structure`; `release.pulse` (none);
//! `release.eddy_size_m` (m; none), see the filaments' `size`; `release.nozzle` (none).
//!
//! *Deviations*: the paper counts molecules in arbitrary units; here the quantity is mass. The vertical limit is not in
//! the paper. In stratified water no eddy overturns more than about the Ozmidov length (ε/N³)^½, so a filament cannot
//! get thicker (Pearson, Puttock & Hunt 1983, J. Fluid Mech. 129, 219). A nozzle of diameter d releases, at its speed
//! U, a thread of filaments of size d/4, which have the variance of a disc: U/(d/4) of them per second, so that each
//! overlaps the next.

use super::buoyancy::{BuoyancySpec, Curve};
use crate::error::PlumeError;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::cost::{Cost, Part, Times};
use world::ranges::{Finite, Fraction, NonNegative, Positive};

/// A source as in the scenario file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SourceSpec {
    /// Name, unique in the scenario.
    #[schemars(extend("pattern" = "^[a-z0-9_]+$"))]
    pub id: String,
    /// East of the datum, m.
    #[serde(with = "world::limits::place_m")]
    pub east_m: Finite,
    /// North of the datum, m.
    #[serde(with = "world::limits::place_m")]
    pub north_m: Finite,
    /// Height above the bed, m; either this or `depth_m`.
    #[serde(default)]
    pub height_m: Option<Finite>,
    /// Depth below the still surface, m; either this or `height_m`.
    #[serde(default)]
    pub depth_m: Option<Finite>,
    /// Mass released, g/s.
    #[serde(with = "world::limits::source_g_s")]
    pub rate_g_s: Positive,
    /// How it is divided into filaments.
    #[serde(default)]
    pub release: ReleaseSpec,
}

/// How a source divides its release into filaments.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ReleaseSpec {
    /// Filaments per second, 1/s.
    pub rate_hz: Positive,
    /// Size (standard deviation of the kernel) at release, m.
    #[serde(with = "world::limits::filament_m")]
    pub initial_size_m: Positive,
    /// Growth of the squared size, m²/s.
    #[serde(with = "world::limits::growth_m2_s")]
    pub growth_m2_s: NonNegative,
    /// Greatest vertical size, m; without it half the local depth.
    #[serde(with = "world::limits::depth_m::<Option<Positive>>")]
    pub vertical_size_limit_m: Option<Positive>,
    /// At random times (true) or at equal intervals (false).
    pub poisson: bool,
    /// Size of the smallest eddies that are resolved, m. Below it a filament grows by the eddies smaller than itself
    /// instead of by `growth_m2_s`, and only the larger ones kick it.
    #[serde(with = "world::limits::filament_m::<Option<Positive>>")]
    pub eddy_size_m: Option<Positive>,
    /// Whether the release is lighter or heavier than the water around.
    pub buoyancy: BuoyancySpec,
    /// Volume released, L/s; a nozzle sets it. A buoyant release needs it.
    #[serde(with = "world::limits::volume_l_s::<Option<Positive>>")]
    pub volume_l_s: Option<Positive>,
    /// How much of the variance that stirring makes and mixing leaves a probe meets below the size of a filament: 0 is
    /// none, 1 all. With it, a release needs its volume or a nozzle.
    pub structure: Fraction,
    /// When it is open; always, if nothing is said. `rate_g_s` is then what it releases while it is open.
    pub pulse: Option<PulseSpec>,
    /// A nozzle that releases a thread; it sets `rate_hz`, `initial_size_m` and equal intervals.
    pub nozzle: Option<NozzleSpec>,
}

/// A source that opens and closes by the clock of the water, which begins with the spin-up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PulseSpec {
    /// Time for which it is open, s.
    pub on_s: Positive,
    /// Time for which it is then closed, s.
    pub off_s: Positive,
}

impl PulseSpec {
    /// Whether it is open at a time, s.
    pub(crate) fn open(&self, t_s: f64) -> bool {
        t_s.rem_euclid(self.on_s.get() + self.off_s.get()) < self.on_s.get()
    }
}

/// A round nozzle in the stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NozzleSpec {
    /// Inner diameter, m.
    #[serde(with = "world::limits::nozzle_m")]
    pub diameter_m: Positive,
    /// Speed of the fluid that leaves it, m/s; iso-kinetic if it is that of the water around.
    #[serde(with = "world::limits::nozzle_m_s")]
    pub speed_m_s: Positive,
}

/// Memory of a filament with its place in the index, twice while the arrays grow, bytes.
const FILAMENT_BYTES: f64 = 100.0;
/// Time to move a filament, s.
const FILAMENT_S: f64 = 17e-9;
/// Additional time with eddies, s.
const EDDIES_S: f64 = 60e-9;
/// Additional time of a buoyant one, s.
const RISE_S: f64 = 30e-9;

impl NozzleSpec {
    /// Volume released, m³/s.
    pub fn volume_m3_s(&self) -> f64 {
        let d = self.diameter_m.get();
        std::f64::consts::FRAC_PI_4 * d * d * self.speed_m_s.get()
    }
}

impl ReleaseSpec {
    /// The same release with the values that a nozzle sets: filaments with the variance of its disc, (d/4)², one
    /// standard deviation apart.
    pub fn settled(&self) -> Self {
        let Some(nozzle) = &self.nozzle else {
            return self.clone();
        };
        let size = nozzle.diameter_m.get() / 4.0;
        Self {
            // Within its range as long as speed and diameter are within theirs.
            rate_hz: Positive::new(nozzle.speed_m_s.get() / size),
            initial_size_m: Positive::new(size),
            poisson: false,
            ..self.clone()
        }
    }

    /// Buoyancy of the n-th source's release in water of this density; `None` if it is neutral.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    pub fn curve(&self, n: usize, density_kg_m3: f64) -> Result<Option<Curve>, PlumeError> {
        let curve = self.buoyancy.curve(density_kg_m3);
        curve.map_err(|(field, problem)| PlumeError::new(format!("sources[{n}].release.buoyancy.{field}"), problem))
    }

    /// Volume that the n-th source releases (m³/s), and the radius at which it leaves it (m): the nozzle's, or that of a
    /// disc with the variance of the filaments.
    ///
    /// # Errors
    /// If the release says neither a volume nor a nozzle, or both.
    pub fn outflow(&self, n: usize) -> Result<(f64, f64), PlumeError> {
        match (&self.nozzle, self.volume_l_s) {
            (Some(nozzle), None) => Ok((nozzle.volume_m3_s(), 0.5 * nozzle.diameter_m.get())),
            (None, Some(volume)) => Ok((1e-3 * volume.get(), 2.0 * self.initial_size_m.get())),
            (nozzle, _) => {
                let problem = match nozzle {
                    Some(_) => "the nozzle sets the volume: leave it out",
                    None => {
                        "a release that is buoyant or has structure needs the volume that it releases, in L/s (from 1e-9 to 1e7)"
                    }
                };
                Err(PlumeError::new(format!("sources[{n}].release.volume_l_s"), problem))
            }
        }
    }

    /// What the filaments need in an area whose water carries them at `carries_m_s`. Filaments that eddies or slow
    /// water keep longer are not counted.
    pub fn cost(&self, area: &Area, carries_m_s: f64, times: &Times) -> Cost {
        let rate_hz = self.settled().rate_hz.get();
        let (path, value, power) = match &self.nozzle {
            None => ("rate_hz", rate_hz, 1.0),
            Some(nozzle) => ("nozzle.diameter_m", nozzle.diameter_m.get(), -1.0),
        };
        let stays_s = (area.length_m + area.width_m) / carries_m_s.max(1e-9);
        let whole_s = times.whole_s();
        let most = rate_hz * whole_s.min(stays_s);
        // Their number rises to its maximum and then stays.
        let rising = (0.5 * stays_s / whole_s).clamp(0.0, 0.5);
        let each_s = FILAMENT_S
            + if self.eddy_size_m.is_some() { EDDIES_S } else { 0.0 }
            + if self.buoyancy == BuoyancySpec::Neutral { 0.0 } else { RISE_S };
        let part = Part::new(path, format!("{most:.2e} filaments at once"))
            .holds(most * FILAMENT_BYTES)
            .takes(most * (1.0 - rising) * times.drifts() * each_s)
            .by(value, power);
        Cost::single(part)
    }
}

impl Default for ReleaseSpec {
    fn default() -> Self {
        Self {
            rate_hz: Positive::new(5.0),
            initial_size_m: Positive::new(0.031_622_776),
            growth_m2_s: NonNegative::new(0.001),
            vertical_size_limit_m: None,
            poisson: true,
            eddy_size_m: None,
            buoyancy: BuoyancySpec::Neutral,
            volume_l_s: None,
            structure: Fraction::new(0.0),
            pulse: None,
            nozzle: None,
        }
    }
}

/// A source placed in the water.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Name.
    pub id: String,
    /// Position, ENU, m.
    pub p_W: Vector3<f64>,
    /// Mass of one filament, kg.
    pub filament_kg: f64,
    /// How it is divided into filaments.
    pub release: ReleaseSpec,
}
