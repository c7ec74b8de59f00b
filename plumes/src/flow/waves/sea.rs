//! Surface waves: the sum of wave trains and a wind sea. Hulls and instruments feel orbits, the plume drift and mixing.
//!
//! *Source*: linear superposition of the waves of `airy`. For filaments, the Lagrangian mean of Andrews & McIntyre
//! 1978, J. Fluid Mech. 89, 609: mean places move with the current plus Stokes' drift, and a particle is at its mean
//! place plus the displacement by the orbit. Vertical mixing under waves K_z = 0.028 H²/T e^(2kz), attributed to Ichiye
//! from dye (1967, Phys. Fluids 10(9), S270): a secondary source, see (6).
//!
//! *Parameters*: `trains` (regular waves: `height_m` from trough to crest, `period_s`, `heading_deg` of their travel,
//! `phase_deg` at the area's centre at time zero, drawn if absent), `spectrum` (file `spectrum`), `stokes` drift on or off
//! (on), `mixing` Ichiye's coefficient (0.028; 0 omits it).
//!
//! *Deviations*: (1) the plume's grid of currents is evaluated every few seconds and would alias waves of seconds, so
//! it leaves the orbits out. Filaments are stored at their mean places and moved by the current and Stokes' drift. A
//! fixed source releases at p − ξ(p, t), and a question for the concentration at p is answered for p − ξ(p, t), with ξ
//! the displacement by the orbit: first order in the steepness. So dye moves past a fixed probe with the waves, and a
//! probe near the surface is in the air in a trough. (2) Drift sums over waves one by one; two of the same period in
//! different directions would add a standing part. No undertow returns the drift. (3) For the mixing, H² is 16
//! variances and T the period of a train or of the spectrum's peak. (4) Over a bed that is not level, the waves are
//! those of the depth at the area's centre: there is no shoaling and no refraction, and elsewhere at the bed the water
//! is not quite tangent to it. Obstacles do not bend or shelter waves. (5) Waves do not thicken the bed's boundary
//! layer. (6) The paper of 1967 was not available; form and coefficient are as oil-spill models give them. A
//! coefficient twice as large makes the layer of dye that waves alone have mixed √2 times as thick and its middle
//! weaker by the same factor. Under the sea of 0.35 m and 2.6 s of dalian_bay, K_z is 13 cm²/s at the surface and 2.2
//! cm²/s at 1.5 m, and σ_z grows by 0.9 m in the half hour to 350 m; with twice the coefficient, by 1.2 m. Stirring by
//! the wind is not included: by Sundby 1983, Deep-Sea Res. 30, 645, K = 76 + 2.26 U² cm²/s for U in m/s, a wind of 7
//! m/s has 190 cm²/s.

use nalgebra::{Rotation2, Vector2, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use world::fields::WaterSample;
use world::math;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::seeds::{Seed, Stream};

use super::airy::{Airy, wave_number};
use super::spectrum::SpectrumSpec;
use crate::error::PlumeError;

/// Waves on the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WavesSpec {
    /// Regular waves.
    #[serde(default)]
    pub trains: Vec<TrainSpec>,
    /// A wind sea.
    #[serde(default)]
    pub spectrum: Option<SpectrumSpec>,
    /// Whether Stokes' drift carries the plume.
    #[serde(default = "yes")]
    pub stokes: bool,
    /// Ichiye's coefficient of the mixing.
    #[serde(default = "ichiye", with = "world::limits::wave_mixing")]
    pub mixing: NonNegative,
}

/// One regular wave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrainSpec {
    /// Height from trough to crest, m.
    #[serde(with = "world::limits::wave_m")]
    pub height_m: Positive,
    /// Period at a fixed place, s.
    #[serde(with = "world::limits::wave_s")]
    pub period_s: Positive,
    /// Where the train travels, degrees clockwise from north.
    pub heading_deg: HeadingDeg,
    /// Phase at the area's centre at time zero, degrees; 0 is a crest. Drawn from the seed if absent.
    #[serde(default)]
    pub phase_deg: Option<Finite>,
}

const fn yes() -> bool {
    true
}

const fn ichiye() -> NonNegative {
    NonNegative::new(0.028)
}

/// The waves, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Waves {
    waves: Vec<Airy>,
    depth: f64,
    // Stokes' drift (east, north) and K_z at evenly spaced heights from bed to surface.
    profile: Vec<(Vector2<f64>, f64)>,
}

impl Waves {
    /// With phases that are those at a place (east, north), and not at the datum: they must not depend on where that is.
    pub(crate) fn with_phases_at(mut self, place: Vector2<f64>) -> Self {
        for wave in &mut self.waves {
            wave.begin_at(place);
        }
        self
    }
}

/// Levels of the profile, which is linear between them.
const LEVELS: usize = 1024;
/// Waves steeper than this times tanh kh break (Miche 1944, Ann. Ponts Chauss. 114, 25).
const MICHE: f64 = 0.142;

impl WavesSpec {
    /// The waves on water `depth_m` deep, checked; values that are not given come from the seed.
    ///
    /// # Errors
    /// Names the field: no waves at all, too many, or so steep that they would break.
    pub fn build(&self, field: &str, depth_m: f64, seed: impl Into<Seed>) -> Result<Waves, PlumeError> {
        let seed = seed.into();
        let bad = |sub: &str, problem: String| PlumeError::Invalid { field: format!("{field}{sub}"), problem };
        let steep = |sub: &str, height: f64, period: f64| {
            let k = wave_number(TAU / period, depth_m);
            let most = MICHE * TAU / k * math::tanh(k * depth_m);
            let problem = format!(
                "must be > 0 and at most {most:.3} (waves of {period} s in {depth_m} m of water break beyond), got {height}"
            );
            if height > most { Err(bad(sub, problem)) } else { Ok(k) }
        };
        let mut rng = Stream::new(seed, field, "wave phases");
        let mut waves = Vec::new();
        // Variance, period and wave number of each system.
        let mut systems = Vec::new();
        for (n, train) in self.trains.iter().enumerate() {
            // Drawn even if it is not used, so that giving one phase does not change another.
            let drawn = TAU * rng.uniform();
            let phase = train.phase_deg.map_or(drawn, |p| p.get().to_radians());
            let (height, period) = (train.height_m.get(), train.period_s.get());
            let k = steep(&format!(".trains[{n}].height_m"), height, period)?;
            let along = train.heading_deg.heading().unit();
            let wave = Airy::new(0.5 * height, TAU / period, along, phase, depth_m);
            systems.push((wave.variance(), period, k));
            waves.push(wave);
        }
        if let Some(sea) = &self.spectrum {
            if !(1..=200).contains(&sea.components) {
                let problem = format!("must be from 1 to 200, got {}", sea.components);
                return Err(bad(".spectrum.components", problem));
            }
            let (height, period) = (sea.significant_height_m.get(), sea.peak_period_s.get());
            let k = steep(".spectrum.significant_height_m", height, period)?;
            let mean = sea.heading_deg.heading().unit();
            for w in sea.draw(&mut Stream::new(seed, field, "wind sea")) {
                let along = Rotation2::from_matrix_unchecked(turn(w.turned)) * mean;
                waves.push(Airy::new(w.amplitude_m, w.omega, along, w.phase, depth_m));
            }
            systems.push((height * height / 16.0, period, k));
        }
        if waves.is_empty() {
            let problem = "needs trains or a spectrum, got neither".to_owned();
            return Err(bad("", problem));
        }
        let profile = (0..LEVELS).map(|n| {
            let z = depth_m * (n as f64 / (LEVELS - 1) as f64 - 1.0);
            let drift = if self.stokes { waves.iter().map(|w| w.drift(z)).sum() } else { Vector2::zeros() };
            let of = |(m0, t, k): &(f64, f64, f64)| 16.0 * m0 / t * math::exp(2.0 * k * z);
            let stirred = self.mixing.get() * systems.iter().map(of).sum::<f64>();
            (drift, stirred)
        });
        Ok(Waves { profile: profile.collect(), depth: depth_m, waves })
    }
}

impl WavesSpec {
    /// Number of waves that are summed.
    pub fn count(&self) -> f64 {
        let sea = self.spectrum.as_ref().map_or(0, |s| s.components);
        self.trains.len() as f64 + f64::from(sea)
    }
}

/// Rotation anticlockwise by an angle, rad.
fn turn(angle: f64) -> nalgebra::Matrix2<f64> {
    let (sin, cos) = math::sin_cos(angle);
    nalgebra::Matrix2::new(cos, -sin, sin, cos)
}

impl Waves {
    /// Orbital velocity at a place (ENU, m), m/s.
    pub fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        self.waves.iter().map(|w| w.velocity(p, t_s)).sum()
    }

    /// Adds orbital velocity, its gradient and rate of change to those of the rest of the water.
    pub(crate) fn add_to(&self, sample: &mut WaterSample, p: &Vector3<f64>, t_s: f64) {
        for w in &self.waves {
            w.add_to(sample, p, t_s);
        }
    }

    /// Displacement of the water whose mean place is `p`, m; at the surface, its height is the surface's.
    pub fn displacement(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        self.waves.iter().map(|w| w.displacement(p, t_s)).sum()
    }

    /// Head of the waves' pressure at a place, m of water.
    pub fn head(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        self.waves.iter().map(|w| w.head(p, t_s)).sum()
    }

    /// Stokes' drift (east, north) at a height, m/s; zero if it is off.
    pub fn drift(&self, z: f64) -> Vector2<f64> {
        let (n, part) = self.level(z);
        self.profile[n].0.lerp(&self.profile[n + 1].0, part)
    }

    /// Vertical diffusivity by waves at a height, m²/s.
    pub fn vertical(&self, z: f64) -> f64 {
        let (n, part) = self.level(z);
        self.profile[n].1 + (self.profile[n + 1].1 - self.profile[n].1) * part
    }

    /// Variance of the surface, m².
    pub fn variance(&self) -> f64 {
        self.waves.iter().map(Airy::variance).sum()
    }

    fn level(&self, z: f64) -> (usize, f64) {
        let at = (z / self.depth + 1.0).clamp(0.0, 1.0) * (LEVELS - 1) as f64;
        let n = (at as usize).min(LEVELS - 2);
        (n, at - n as f64)
    }

    #[cfg(test)]
    pub(super) fn waves(&self) -> &[Airy] {
        &self.waves
    }
}
