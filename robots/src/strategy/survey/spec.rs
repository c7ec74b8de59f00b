//! Parameters of the time after a declaration.

use super::add_up_spec::AddUpSpec;
use super::detect_spec::DetectSpec;
use super::verifier_spec::VerifierSpec;
use crate::error::{RobotError, require};
use crate::handoff::Need;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{Finite, Positive};

/// Most lines of either kind.
const MOST_LINES: usize = 32;
/// Most pictures over a point.
const MOST_HELD: u32 = 50;

/// What a vehicle with passes for a camera does without one.
pub(crate) const BLIND: &str = "sees nothing on the passes for it";

/// What follows the declaration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum AfterDeclaration {
    /// Go home; the mission is completed there.
    #[default]
    GoHome,
    /// Complete the mission on the spot.
    Stop,
    /// Passes over the declared place. If it is verified (or nothing on board could look), the vehicle goes home; if
    /// it is rejected, the vehicle continues the search.
    Survey(Box<SurveySpec>),
}

impl AfterDeclaration {
    /// The instruments that it needs; paths below the strategy.
    pub fn needs(&self) -> Vec<Need> {
        match self {
            Self::Survey(spec) => spec.needs("after_declaration"),
            Self::GoHome | Self::Stop => Vec::new(),
        }
    }
}

/// A survey of a declared place.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SurveySpec {
    /// Passes for the sidescan; its best object becomes the centre of the camera's passes.
    #[default(Some(SidescanPasses::default()))]
    pub sidescan: Option<SidescanPasses>,
    /// Passes for the camera, after the sidescan's.
    pub camera: Option<CameraPasses>,
    /// What must have seen a source.
    #[default(Verify::Sidescan)]
    pub verify: Verify,
    /// Points where the plume was lost are forgotten within this distance of a rejected place, m.
    #[default(Positive::new(30.0))]
    pub forget_m: Positive,
}

impl SurveySpec {
    /// The instruments that it needs; paths below `path`.
    pub fn needs(&self, path: &str) -> Vec<Need> {
        let far = "never knows how far the bed is that it looks at";
        let mut needs = Vec::new();
        if self.sidescan.is_some() {
            needs.push(Need::vital("sidescan", "sidescan", "hears nothing on the passes for it"));
            needs.push(Need::vital("sidescan", "altimeter", far));
        }
        if let Some(camera) = &self.camera {
            needs.push(Need::vital("camera", "camera", BLIND));
            if camera.add_up.is_some() {
                needs.push(Need::vital("camera.add_up", "altimeter", far));
            }
        }
        needs.into_iter().map(|n| n.within(path)).collect()
    }
}

/// Lines for the sidescan.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SidescanPasses {
    /// Distances of the lines from the place, across the flow, m; the lines lie along the flow.
    #[default([-8.0, 8.0].map(Finite::new).into())]
    pub offsets_m: Vec<Finite>,
    /// Half their length, m.
    #[default(Positive::new(30.0))]
    pub half_length_m: Positive,
    /// Height above the bed, m.
    #[default(Positive::new(3.0))]
    pub altitude_m: Positive,
    /// An object counts only within this distance of the declared place, m.
    #[default(Positive::new(30.0))]
    pub within_m: Positive,
    /// When a bright return counts as an object.
    pub detect: DetectSpec,
}

/// Lines for the camera.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraPasses {
    /// Distances of the lines from the place, across the flow, m.
    #[default([Finite::new(0.0)].into())]
    pub offsets_m: Vec<Finite>,
    /// Half their length, m.
    #[default(Positive::new(15.0))]
    pub half_length_m: Positive,
    /// Height above the bed, m.
    #[default(Positive::new(2.0))]
    pub altitude_m: Positive,
    /// Time between two pictures, s.
    #[default(Positive::new(1.0))]
    pub period_s: Positive,
    /// Pictures that a vehicle that hovers takes over each point that it holds, up to 50: over the points that
    /// `add_up` asks for, and over the middle of each line at a place that `Inspect` was told. Others fly lines; 0: all
    /// do.
    #[default(10)]
    pub held_pictures: u32,
    /// When a picture shows a source.
    pub verifier: VerifierSpec,
    /// Adds up all pictures of the place instead; `offsets_m` and `verifier` are then not used, `altitude_m` is the
    /// highest altitude, and lines are flown where and as low as the pictures ask for.
    pub add_up: Option<AddUpSpec>,
}

/// Which instruments must have seen a source for a declaration to be verified; otherwise it is rejected. An
/// instrument that never reported is ignored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Verify {
    /// An object seen by the sidescan.
    #[default]
    Sidescan,
    /// A source giving off dye, seen by the camera.
    Camera,
    /// Either of the two.
    Either,
    /// The two.
    Both,
}

impl SurveySpec {
    /// Checks that its parts agree.
    ///
    /// # Errors
    /// Names the field below `path` and the legal values.
    pub fn check(&self, path: &str) -> Result<(), RobotError> {
        let must = |holds: bool, field: &str, problem: String| require(holds, format!("{path}.{field}"), problem);
        let offsets = [
            ("sidescan", self.sidescan.as_ref().map(|p| &p.offsets_m)),
            ("camera", self.camera.as_ref().map(|p| &p.offsets_m)),
        ];
        for (part, offsets) in offsets {
            if let Some(n) = offsets.map(Vec::len) {
                let problem = format!("must have from 1 to {MOST_LINES} lines, got {n}");
                must((1..=MOST_LINES).contains(&n), &format!("{part}.offsets_m"), problem)?;
            }
        }
        let (sonar, eyes) = (self.sidescan.is_some(), self.camera.is_some());
        let flown = match self.verify {
            Verify::Sidescan => sonar,
            Verify::Camera => eyes,
            Verify::Either => sonar || eyes,
            Verify::Both => sonar && eyes,
        };
        let problem =
            format!("{:?} needs passes that are not flown: add them, or choose another `verify`", self.verify);
        must(flown, "verify", problem)?;
        match &self.camera {
            Some(c) => {
                let problem = format!("must be from 0 to {MOST_HELD}, got {}", c.held_pictures);
                must(c.held_pictures <= MOST_HELD, "camera.held_pictures", problem)?;
                c.verifier.check(&format!("{path}.camera.verifier"))?;
                c.add_up.as_ref().map_or(Ok(()), |a| a.check(&format!("{path}.camera.add_up"), c.altitude_m.get()))
            }
            None => Ok(()),
        }
    }
}
