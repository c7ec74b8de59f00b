//! What a fault does to the readings of an instrument.

use super::instrument_spec::{DensityFault, DyeFault, EyeFault, FixFault, HeadingFault, MetresFault, SpeedFault};
use nalgebra::Vector2;

/// What a fault does to readings.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ReadingFault {
    Silent,
    Stuck,
    /// Too large by so much in a unit.
    Biased(f64, &'static str),
    /// Too large by ever more in a unit, for each second.
    Drifting(f64, &'static str),
    /// Displaced (east, north), m, growing over a time, s.
    Displaced(Vector2<f64>, f64),
}

impl ReadingFault {
    /// By how much a number is too large after a time, in the instrument's own unit.
    pub(super) fn off(&self, lasted_s: f64) -> f64 {
        match self {
            Self::Biased(by, _) => *by,
            Self::Drifting(by, _) => by * lasted_s,
            Self::Silent | Self::Stuck | Self::Displaced(..) => 0.0,
        }
    }

    /// By how much a position is displaced after a time, m.
    pub(super) fn displaced(&self, lasted_s: f64) -> Vector2<f64> {
        match self {
            Self::Displaced(by, over_s) if lasted_s < *over_s => by * (lasted_s / over_s),
            Self::Displaced(by, _) => *by,
            _ => Vector2::zeros(),
        }
    }

    /// In words, for people.
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Silent => "silent".to_string(),
            Self::Stuck => "stuck".to_string(),
            Self::Biased(by, unit) => format!("off by {by} {unit}"),
            Self::Drifting(by, unit) => format!("drifting by {by} {unit} in each second"),
            Self::Displaced(by, over_s) => {
                let over = if *over_s > 0.0 { format!(" within {over_s} s") } else { String::new() };
                format!("displaced by {} m E, {} m N{over}", by.x, by.y)
            }
        }
    }
}

macro_rules! amiss {
    ($($spec:ident in $unit:literal),*) => {$(
        impl From<&$spec> for ReadingFault {
            fn from(spec: &$spec) -> Self {
                match spec {
                    $spec::Silent => Self::Silent,
                    $spec::Stuck => Self::Stuck,
                    $spec::Biased(by) => Self::Biased(by.get(), $unit),
                    $spec::Drifting(by) => Self::Drifting(by.get(), $unit),
                }
            }
        }
    )*};
}

amiss!(
    DyeFault in "µg/L",
    HeadingFault in "degrees",
    MetresFault in "m",
    SpeedFault in "m/s",
    DensityFault in "kg/m³"
);

impl From<&EyeFault> for ReadingFault {
    fn from(spec: &EyeFault) -> Self {
        match spec {
            EyeFault::Silent => Self::Silent,
            EyeFault::Stuck => Self::Stuck,
        }
    }
}

impl From<&FixFault> for ReadingFault {
    fn from(spec: &FixFault) -> Self {
        match spec {
            FixFault::Silent => Self::Silent,
            FixFault::Stuck => Self::Stuck,
            FixFault::Lie(lie) => {
                let by = Vector2::new(lie.east_m.get(), lie.north_m.get());
                Self::Displaced(by, lie.over_s.get())
            }
        }
    }
}
