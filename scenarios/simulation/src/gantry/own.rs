//! All components of a gantry: what it keeps while the gantry of another run has its turn in the same world.

use super::system::{Head, Rig};
use crate::control::exchanges::ExchangeState;
use crate::machines::own;
use crate::searchers::{OnboardTime, SearcherId, SearcherParts};
use robots::handoff::{Decision, GantryReadings, HeadGoal};

own! {
    /// All components of a gantry.
    GantryOwn as GantryParts with GantryBundle {
        id: SearcherId,
        now: OnboardTime,
        rig: Rig,
        head: Head,
        readings: GantryReadings,
        searching: SearcherParts<HeadGoal>,
        decision: Decision<HeadGoal>,
    } some {
        consulting: ExchangeState,
    } shown {
    }
}
