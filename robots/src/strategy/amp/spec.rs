//! Parameters of the adaptive mission planner.

use super::super::survey::AfterDeclaration;
use super::super::wishes::VerticalSpec;
use crate::behave::{FindSpec, ReacquireSpec, TrackInSpec, TrackOutSpec};
use crate::declare::DeclareSpec;
use crate::memory::{FixMove, LCDPS};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::catalogue::Entry;
use world::ranges::{Finite, Positive};
use world::registry::Listed;

/// Composition and parameters; every default is the paper's.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AmpSpec {
    /// Speed over ground, m/s (section 6: 2).
    #[default(Positive::new(2.0))]
    pub speed_m_s: Positive,
    /// Altitude or depth (section 6: 2 m above the bed in the single-source mission).
    #[default(VerticalSpec::Altitude(Positive::new(2.0)))]
    pub vertical: VerticalSpec,
    /// Destination before the search; without it the search begins at once.
    pub start_at: Option<StartAt>,
    /// Search for the plume.
    pub find: FindSpec,
    /// In the plume.
    pub track_in: TrackInSpec,
    /// Just out of the plume.
    pub track_out: TrackOutSpec,
    /// Search around the points where the plume was lost.
    pub reacquire: ReacquireSpec,
    /// The declaration rule.
    pub declare: DeclareSpec,
    /// Length of the lost-points list (section 5.3: 6).
    #[default(NonZeroUsize::new(6).expect("6 is not zero"))]
    pub lost_points: NonZeroUsize,
    /// Most last detection points for the SIZ rules; a full queue forgets the oldest (Tian et al. 2013 keep all:
    /// 1000).
    #[default(LCDPS)]
    pub lcdps: NonZeroUsize,
    /// What happens to lost points and last detection points when a navigation fix moves the vehicle (default: they
    /// stay).
    pub fixes: FixMove,
    /// What follows the declaration.
    pub after_declaration: AfterDeclaration,
}

impl Listed for AmpSpec {
    const ENTRY: Entry = Entry {
        name: "Amp",
        what: "adaptive mission planner: find, track in, track out, reacquire, declare, go home",
        source: "Pang 2009, section 5, Fig. 5",
    };
}

/// A destination before the search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartAt {
    /// East, m.
    pub east_m: Finite,
    /// North, m.
    pub north_m: Finite,
    /// Meaning of detections on the way.
    #[serde(default)]
    pub detections: Detections,
}

/// Meaning of detections on the way to the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Detections {
    /// They are ignored: the rule for transits (section 6).
    #[default]
    Ignored,
    /// The first one starts the tracing, wherever it occurs.
    Heeded,
}
