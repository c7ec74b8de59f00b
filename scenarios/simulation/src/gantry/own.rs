//! All components of a gantry: what it keeps while the gantry of another run has its turn in the same world.

use super::system::{Head, Rig, Searcher};
use crate::control::exchanges::ExchangeState;
use crate::machines::own;
use crate::searchers::SearcherId;
use robots::handoff::{GantryDecision, GantryReadings};

own! {
    /// All components of a gantry.
    GantryOwn as GantryParts with GantryBundle {
        id: SearcherId,
        rig: Rig,
        head: Head,
        readings: GantryReadings,
        searcher: Searcher,
        decision: GantryDecision,
    } some {
        consulting: ExchangeState,
    } shown {
    }
}
