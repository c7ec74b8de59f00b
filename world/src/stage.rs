//! The stages of the tick, in the order in which `scenarios/simulation/src/tick.rs` chains them.

use bevy_ecs::prelude::SystemSet;

/// One stage of the tick.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Instruments measure the truth, with their noise, rate and range.
    Sense,
    /// Readings become the vehicle's estimate of its own state and of the water.
    Estimate,
    /// Belief about where the source may be.
    Map,
    /// A strategy chooses behaviour and goal.
    Decide,
    /// A goal becomes commands for heading, speed and depth.
    Guide,
    /// Commands become actuator set-points.
    Actuate,
    /// Bodies move and touch.
    Physics,
    /// Water and dissolved matter move.
    Drift,
    /// The state is digested, recorded and published.
    Report,
}

impl Stage {
    /// All stages in order.
    pub const ALL: [Stage; 9] = [
        Stage::Sense,
        Stage::Estimate,
        Stage::Map,
        Stage::Decide,
        Stage::Guide,
        Stage::Actuate,
        Stage::Physics,
        Stage::Drift,
        Stage::Report,
    ];
}
