//! How an instrument can fail: one choice for each kind of number that it reports.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Finite, NonNegative};

/// How a fluorometer fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum DyeFault {
    /// No readings.
    Silent,
    /// It repeats its last reading.
    Stuck,
    /// It reads so much more dye than there is, µg/L; the reading stays between zero and full scale.
    Biased(#[serde(with = "world::limits::bias_ug_l")] Finite),
    /// It reads ever more dye than there is, µg/L in each second.
    Drifting(#[serde(with = "world::limits::drift_ug_l_s")] Finite),
}

/// How a compass fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum HeadingFault {
    /// No readings.
    Silent,
    /// It repeats its last reading.
    Stuck,
    /// The heading is turned by so much, clockwise, degrees.
    Biased(#[serde(with = "world::limits::bias_deg")] Finite),
    /// The heading turns away, clockwise, degrees in each second.
    Drifting(#[serde(with = "world::limits::drift_deg_s")] Finite),
}

/// How an instrument fails that reports a depth or a range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum MetresFault {
    /// No readings.
    Silent,
    /// It repeats its last reading.
    Stuck,
    /// It reads so much more than there is, m; a range stays at zero or above.
    Biased(#[serde(with = "world::limits::bias_m")] Finite),
    /// It reads ever more than there is, m in each second.
    Drifting(#[serde(with = "world::limits::drift_m_s")] Finite),
}

/// How an instrument fails that reports a velocity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum SpeedFault {
    /// No readings.
    Silent,
    /// It repeats its last reading.
    Stuck,
    /// The velocity ahead is too large by so much, m/s; what the instrument calls invalid stays as it is.
    Biased(#[serde(with = "world::limits::component_m_s")] Finite),
    /// The velocity ahead grows, m/s in each second.
    Drifting(#[serde(with = "world::limits::drift_m_s2")] Finite),
}

/// How an instrument fails that reports a density.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum DensityFault {
    /// No readings.
    Silent,
    /// It repeats its last reading.
    Stuck,
    /// The water reads denser by so much, kg/m³.
    Biased(#[serde(with = "world::limits::excess_kg_m3")] Finite),
    /// The water reads ever denser, kg/m³ in each second.
    Drifting(#[serde(with = "world::limits::drift_kg_m3_s")] Finite),
}

/// How an instrument fails that reports pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum EyeFault {
    /// No pictures.
    Silent,
    /// It repeats its last picture.
    Stuck,
}

/// How position fixes fail.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum FixFault {
    /// No fixes.
    Silent,
    /// The last fix is repeated.
    Stuck,
    /// Fixes are displaced.
    Lie(LieSpec),
}

/// By how much fixes are displaced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LieSpec {
    /// To the east, m.
    #[serde(default = "none", with = "world::limits::bias_m")]
    pub east_m: Finite,
    /// To the north, m.
    #[serde(default = "none", with = "world::limits::bias_m")]
    pub north_m: Finite,
    /// Time over which the displacement grows to its full size, s; zero means that it jumps.
    #[serde(default = "at_once")]
    pub over_s: NonNegative,
}

fn none() -> Finite {
    Finite::new(0.0)
}

fn at_once() -> NonNegative {
    NonNegative::new(0.0)
}
