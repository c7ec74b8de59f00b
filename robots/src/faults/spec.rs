//! A fault as a scenario states it: when, of what, and how.

use super::drive_spec::{DriveFault, DriveSpec, FinFault, PropellerFault};
use super::instrument_spec::{DensityFault, DyeFault, EyeFault, FixFault, HeadingFault, MetresFault, SpeedFault};
use super::reading_fault::ReadingFault;
use super::span::Span;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{NonNegative, Positive};

/// A fault of a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FaultSpec {
    /// When it begins, s of mission time.
    pub at_s: NonNegative,
    /// When it ends, s of mission time; without it, it lasts.
    #[serde(default)]
    pub until_s: Option<Positive>,
    /// What fails, and how.
    pub what: Faulty,
}

/// What fails, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Faulty {
    /// The fluorometer; its number is the concentration.
    Fluorometer(DyeFault),
    /// The compass; its number is the heading. Roll, pitch and rates fall silent or stick with it.
    Compass(HeadingFault),
    /// The depth sensor; its number is the depth.
    Depth(MetresFault),
    /// The altimeter; its number is the height above the bed.
    Altimeter(MetresFault),
    /// The forward ranging; its number is the range of each echo.
    Ranging(MetresFault),
    /// The Doppler log; its number is the velocity over ground, ahead.
    Dvl(SpeedFault),
    /// The current profiler; its number is the velocity of the water relative to the vehicle, ahead.
    Adcp(SpeedFault),
    /// The CTD; its number is the density.
    Ctd(DensityFault),
    /// The sidescan sonar.
    Sidescan(EyeFault),
    /// The camera.
    Camera(EyeFault),
    /// The position fixes, those of `sensors.lbl`.
    Fixes(FixFault),
    /// The rudder.
    Rudder(FinFault),
    /// The stern plane.
    SternPlane(FinFault),
    /// The propeller.
    Propeller(PropellerFault),
    /// A drive by its name.
    Drive(DriveSpec),
}

/// Names of the drives that have a choice of their own.
const RUDDER: &str = "rudder";
const STERN_PLANE: &str = "stern_plane";
const PROPELLER: &str = "propeller";

/// What a fault is of.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FaultSubject<'a> {
    /// An instrument by its field in `sensors`.
    Instrument(&'static str, ReadingFault),
    /// A drive by its name.
    Drive(&'a str, DriveFault),
}

impl Faulty {
    /// What it is of.
    pub(super) fn subject(&self) -> FaultSubject<'_> {
        match self {
            Self::Fluorometer(how) => FaultSubject::Instrument("fluorometer", how.into()),
            Self::Compass(how) => FaultSubject::Instrument("compass", how.into()),
            Self::Depth(how) => FaultSubject::Instrument("depth", how.into()),
            Self::Altimeter(how) => FaultSubject::Instrument("altimeter", how.into()),
            Self::Ranging(how) => FaultSubject::Instrument("ranging", how.into()),
            Self::Dvl(how) => FaultSubject::Instrument("dvl", how.into()),
            Self::Adcp(how) => FaultSubject::Instrument("adcp", how.into()),
            Self::Ctd(how) => FaultSubject::Instrument("ctd", how.into()),
            Self::Sidescan(how) => FaultSubject::Instrument("sidescan", how.into()),
            Self::Camera(how) => FaultSubject::Instrument("camera", how.into()),
            Self::Fixes(how) => FaultSubject::Instrument("lbl", how.into()),
            Self::Rudder(how) => FaultSubject::Drive(RUDDER, how.into()),
            Self::SternPlane(how) => FaultSubject::Drive(STERN_PLANE, how.into()),
            Self::Propeller(how) => FaultSubject::Drive(PROPELLER, how.into()),
            Self::Drive(drive) => FaultSubject::Drive(&drive.link, drive.how.clone()),
        }
    }

    /// In words, for people.
    pub fn describe(&self) -> String {
        match self.subject() {
            FaultSubject::Instrument(field, how) => {
                let label = match field {
                    "depth" => "depth sensor",
                    "dvl" => "Doppler log",
                    "adcp" => "current profiler",
                    "ctd" => "CTD",
                    "lbl" => "position fixes",
                    other => other,
                };
                format!("{label} {}", how.describe())
            }
            FaultSubject::Drive(name, how) => {
                let unit = match self {
                    Self::Rudder(_) | Self::SternPlane(_) => "degrees",
                    Self::Propeller(_) => "rpm",
                    _ => "",
                };
                format!("{} {}", name.replace('_', " "), how.describe(unit))
            }
        }
    }
}

impl FaultSpec {
    /// When it holds, in steps of `dt_s`.
    pub fn span(&self, dt_s: f64) -> Span {
        Span::new(self.at_s.get(), self.until_s.map(Positive::get), dt_s)
    }

    /// Whether both hold at some time.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        let ends = |f: &Self| f.until_s.map_or(f64::INFINITY, Positive::get);
        self.at_s.get() < ends(other) && other.at_s.get() < ends(self)
    }
}

#[cfg(test)]
mod tests {
    use super::super::HeadingFault;
    use super::super::testing::fault;
    use super::*;

    #[test]
    fn faults_one_after_the_other_do_not_overlap() {
        let silent = |at_s, until_s| fault(at_s, until_s, Faulty::Compass(HeadingFault::Silent));
        let first = silent(10.0, Some(20.0));
        for (at_s, until_s, overlaps) in [
            (0.0, Some(10.0), false),
            (20.0, None, false),
            (0.0, None, true),
            (12.0, Some(13.0), true),
            (19.0, Some(30.0), true),
        ] {
            assert_eq!(first.overlaps(&silent(at_s, until_s)), overlaps, "{at_s}");
            assert_eq!(silent(at_s, until_s).overlaps(&first), overlaps, "{at_s}");
        }
    }
}
