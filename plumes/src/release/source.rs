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
use world::fields::Flow;
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

/// What a thread of filaments is at its source.
#[derive(Clone, Debug, PartialEq)]
pub struct ThreadStart {
    /// Buoyancy of the released volume by its mixing.
    pub curve: Curve,
    /// Volume released, m³/s.
    pub volume_m3_s: f64,
    /// Radius at which it leaves the source, m.
    pub radius_m: f64,
}

/// Kinematic viscosity of water at 20 °C, m²/s.
pub(crate) const VISCOSITY_M2_S: f64 = 1.0e-6;

/// Resolution of a conductivity probe, m (Webster, Volyanskyy & Weissburg 2012, section 3). Within it, structure must be
/// strained and not carried apart.
const LEAST_EDDY_M: f64 = 5e-4;

/// Kolmogorov's length in water of a dissipation (m²/s³), m.
fn finest_eddies_m(dissipation_m2_s3: f64) -> f64 {
    let per_m4 = dissipation_m2_s3 / (VISCOSITY_M2_S * VISCOSITY_M2_S * VISCOSITY_M2_S);
    1.0 / per_m4.sqrt().sqrt()
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

    /// Of the n-th source, at its place in the water: the thread of which its filaments are pieces. `None` if it is neutral
    /// and has no structure.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    pub fn thread(&self, n: usize, flow: &dyn Flow, p_W: &Vector3<f64>) -> Result<Option<ThreadStart>, PlumeError> {
        let wrong = |field: &str, problem| PlumeError::new(format!("sources[{n}].release.{field}"), problem);
        let structured = self.structure.get() > 0.0;
        let curve = self.buoyancy.curve(flow.density(p_W, 0.0));
        let curve = match curve.map_err(|(field, problem)| wrong(&format!("buoyancy.{field}"), problem))? {
            Some(curve) => curve,
            None if structured => Curve::constant(0.0),
            None => return Ok(None),
        };
        let finest_m = finest_eddies_m(flow.dissipation(p_W, 0.0));
        if structured && finest_m < LEAST_EDDY_M {
            let problem = format!(
                "must be 0 in this water: its finest eddies at the source are {:.2} mm large, and the model of structure \
                 needs at least {:.1} mm, which a probe averages over",
                1e3 * finest_m,
                1e3 * LEAST_EDDY_M
            );
            return Err(wrong("structure", problem));
        }
        let (volume_m3_s, radius_m) = self.outflow(n)?;
        Ok(Some(ThreadStart { curve, volume_m3_s, radius_m }))
    }

    /// Volume that the n-th source releases (m³/s), and the radius at which it leaves it (m): the nozzle's, or that of a
    /// disc with the variance of the filaments.
    ///
    /// # Errors
    /// If the release says neither a volume nor a nozzle, or both.
    fn outflow(&self, n: usize) -> Result<(f64, f64), PlumeError> {
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
