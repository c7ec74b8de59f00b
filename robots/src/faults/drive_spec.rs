//! How a drive can fail: a fin, a propeller, or any by its name.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Finite, Fraction};

/// How a fin fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum FinFault {
    /// It stays at its last set-point.
    Stuck,
    /// It goes to an angle and stays there, degrees; signs as in the table of `OpenLoop`.
    StuckAt(#[serde(with = "world::limits::fin_deg::<Finite>")] Finite),
    /// It takes only this share of each angle that it is asked for.
    Weak(Fraction),
    /// It stays in the middle.
    Dead,
}

/// How a propeller fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum PropellerFault {
    /// It stays at its last set-point.
    Stuck,
    /// It goes to a speed and stays there, rpm.
    StuckAt(#[serde(with = "world::limits::rpm")] Finite),
    /// It turns with only this share of each speed that it is asked for.
    Weak(Fraction),
    /// It stands still.
    Dead,
}

/// A drive of the vehicle by its name, and how it fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DriveSpec {
    /// Name of the drive: `rudder`, `stern_plane` or `propeller`.
    pub link: String,
    /// How it fails.
    pub how: DriveFault,
}

/// How a drive of any kind fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum DriveFault {
    /// It stays at its last set-point.
    Stuck,
    /// It goes to a set-point and stays there: of a fin degrees, of a propeller rpm.
    StuckAt(Finite),
    /// It gives only this share of each set-point.
    Weak(Fraction),
    /// It gives nothing: a fin stays in the middle, a propeller stands still.
    Dead,
}

impl DriveFault {
    /// In words, for people; `unit` is that of the set-points.
    pub(super) fn describe(&self, unit: &str) -> String {
        match self {
            Self::Stuck => "stuck".to_string(),
            Self::StuckAt(value) => format!("stuck at {} {unit}", value.get()).trim_end().to_string(),
            Self::Weak(share) => format!("weak, with {} of each set-point", share.get()),
            Self::Dead => "dead".to_string(),
        }
    }
}

macro_rules! any_drive {
    ($($spec:ident),*) => {$(
        impl From<&$spec> for DriveFault {
            fn from(spec: &$spec) -> Self {
                match spec {
                    $spec::Stuck => Self::Stuck,
                    $spec::StuckAt(value) => Self::StuckAt(*value),
                    $spec::Weak(share) => Self::Weak(*share),
                    $spec::Dead => Self::Dead,
                }
            }
        }
    )*};
}

any_drive!(FinFault, PropellerFault);
