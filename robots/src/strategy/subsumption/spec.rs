//! Parameters of the subsumption planner.

use super::super::survey::SurveySpec;
use super::super::wishes::VerticalSpec;
use super::eyes::EyesSpec;
use super::plume_map::PlumeMapSpec;
use crate::behave::{AvoidParams, FindSpec, ReacquireSpec, TrackInSpec, TrackOutSpec};
use crate::declare::DeclareSpec;
use crate::memory::{FixMove, LCDPS};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;

/// Composition and parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SubsumptionSpec {
    /// Speed over ground, m/s.
    #[serde(default = "two")]
    pub speed_m_s: Positive,
    /// Altitude or depth.
    #[serde(default = "altitude")]
    pub vertical: VerticalSpec,
    /// The layers, lowest first.
    pub layers: Vec<LayerSpec>,
    /// Length of the list of lost points that Reacquire works through (Pang 2009, section 5.3: 6).
    #[serde(default = "six")]
    pub lost_points: NonZeroUsize,
    /// Most last detection points for the SIZ rules; a full queue forgets the oldest (the paper keeps all: 1000).
    #[serde(default = "all")]
    pub lcdps: NonZeroUsize,
    /// What the Declare layer does with a declared place before Go-Home; without it the vehicle goes home at once.
    #[serde(default)]
    pub survey: Option<Box<SurveySpec>>,
    /// Looks at each last detection point with the camera; a source seen there is declared at once.
    #[serde(default)]
    pub eyes: Option<EyesSpec>,
    /// What happens to lost points and last detection points when a navigation fix moves the vehicle (default: they
    /// stay).
    #[serde(default)]
    pub fixes: FixMove,
}

fn two() -> Positive {
    Positive::new(2.0)
}

fn altitude() -> VerticalSpec {
    VerticalSpec::Altitude(two())
}

fn six() -> NonZeroUsize {
    NonZeroUsize::new(6).expect("6 is not zero")
}

fn all() -> NonZeroUsize {
    LCDPS
}

impl SubsumptionSpec {
    /// These layers, with defaults for everything else.
    pub fn with_layers(layers: Vec<LayerSpec>) -> Self {
        Self {
            speed_m_s: two(),
            vertical: altitude(),
            layers,
            lost_points: six(),
            lcdps: all(),
            survey: None,
            eyes: None,
            fixes: FixMove::default(),
        }
    }
}

impl Listed for SubsumptionSpec {
    const ENTRY: Entry = Entry {
        name: "Subsumption",
        what: "layers from the lowest up: find, maintain, reacquire, declare, avoid, plume map, go home; the highest \
            that asks controls the vehicle",
        source: "Tian et al. 2013, section 2, Fig. 3; Brooks 1986, IEEE J. Robotics and Automation RA-2, 14",
    };
}

/// A layer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "SubsumptionLayer")]
#[serde(deny_unknown_fields)]
pub enum LayerSpec {
    /// Looks for the plume; always asks for the vehicle.
    Find(FindSpec),
    /// Keeps in contact with the plume from a detection on.
    Maintain(MaintainSpec),
    /// Searches around the places where contact was lost.
    Reacquire(ReacquireSpec),
    /// Declares the source when the places where contact was lost show it.
    Declare(DeclareSpec),
    /// Turns the course that lower layers ask for away from obstacles.
    Avoid(AvoidParams),
    /// Sends a search without contact to the likeliest source of the robot's map.
    PlumeMap(PlumeMapSpec),
    /// After a declaration: back to the launch point.
    GoHome(GoHomeSpec),
}

/// Maintain-Plume.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MaintainSpec {
    /// In the plume.
    pub track_in: TrackInSpec,
    /// After λ s without a detection (Pang 2009); `None`: Track-Out is the rest of λ, as in Tian et al. 2013.
    #[default(Some(TrackOutSpec::default()))]
    pub track_out: Option<TrackOutSpec>,
}

/// Go-Home; it has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GoHomeSpec {}
