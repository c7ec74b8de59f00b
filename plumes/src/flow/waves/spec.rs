//! Surface waves as a scenario asks for them.

use nalgebra::{Rotation2, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use world::catalogue::Entry;
use world::math;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::registry::Listed;
use world::seeds::{Seed, Stream};

use super::airy::{Airy, wave_number};
use super::sea::{LEVELS, Waves};
use super::spectrum::SpectrumSpec;
use crate::error::PlumeError;
use crate::flow::current::{CurrentParams, CurrentSlot};
use crate::flow::free_water::FreeWater;

/// Waves steeper than this times tanh kh break (Miche 1944, Ann. Ponts Chauss. 114, 25).
const MICHE: f64 = 0.142;

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

impl Listed for WavesSpec {
    const ENTRY: Entry = Entry {
        name: "Waves",
        what: "Surface waves by linear theory, trains or a JONSWAP sea: orbits for hull and instruments, Stokes' drift and mixing for the plume",
        source: "Dean & Dalrymple 1991, Water Wave Mechanics; Hasselmann et al. 1973; Andrews & McIntyre 1978, J. Fluid Mech. 89, 609",
    };
}

impl CurrentParams for WavesSpec {
    fn join(&self, water: &mut FreeWater, place: &CurrentSlot) -> Result<(), PlumeError> {
        if water.waves.is_some() {
            return place.wrong("only one Waves can move the surface; add the second one's trains to the first");
        }
        let depth_m = -water.floor(place.area.centre).z;
        let mut waves = self.build(place.field, depth_m, place.seed)?;
        // Phases are those at the area's centre, and not at the datum: they must not depend on where that is.
        for wave in &mut waves.waves {
            wave.begin_at(place.area.centre);
        }
        water.waves = Some(waves);
        Ok(())
    }

    fn is_steady(&self) -> bool {
        true
    }

    fn waves(&self) -> f64 {
        let sea = self.spectrum.as_ref().map_or(0, |s| s.components);
        self.trains.len() as f64 + f64::from(sea)
    }
}

impl WavesSpec {
    /// The waves on water `depth_m` deep, checked; values that are not given come from the seed.
    ///
    /// # Errors
    /// Names the field: no waves at all, too many, or so steep that they would break.
    pub fn build(&self, field: &str, depth_m: f64, seed: impl Into<Seed>) -> Result<Waves, PlumeError> {
        let seed = seed.into();
        let steep = |sub: &str, height: f64, period: f64| {
            let k = wave_number(TAU / period, depth_m);
            let most = MICHE * TAU / k * math::tanh(k * depth_m);
            let problem = format!(
                "must be > 0 and at most {most:.3} (waves of {period} s in {depth_m} m of water break beyond), got {height}"
            );
            if height > most { Err(PlumeError::new(format!("{field}.{sub}"), problem)) } else { Ok(k) }
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
            let k = steep(&format!("trains[{n}].height_m"), height, period)?;
            let along = train.heading_deg.heading().unit();
            let wave = Airy::new(0.5 * height, TAU / period, along, phase, depth_m);
            systems.push((wave.variance(), period, k));
            waves.push(wave);
        }
        if let Some(sea) = &self.spectrum {
            if !(1..=200).contains(&sea.components) {
                let problem = format!("must be from 1 to 200, got {}", sea.components);
                return Err(PlumeError::new(format!("{field}.spectrum.components"), problem));
            }
            let (height, period) = (sea.significant_height_m.get(), sea.peak_period_s.get());
            let k = steep("spectrum.significant_height_m", height, period)?;
            let mean = sea.heading_deg.heading().unit();
            for w in sea.draw(&mut Stream::new(seed, field, "wind sea")) {
                let along = Rotation2::from_matrix_unchecked(turn(w.turned)) * mean;
                waves.push(Airy::new(w.amplitude_m, w.omega, along, w.phase, depth_m));
            }
            systems.push((height * height / 16.0, period, k));
        }
        if waves.is_empty() {
            return Err(PlumeError::new(field, "needs trains or a spectrum, got neither"));
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

/// Rotation anticlockwise by an angle, rad.
fn turn(angle: f64) -> nalgebra::Matrix2<f64> {
    let (sin, cos) = math::sin_cos(angle);
    nalgebra::Matrix2::new(cos, -sin, sin, cos)
}
