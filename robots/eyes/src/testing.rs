//! The kit of the crate `robots` for tests: observations written by hand.

use robots::handoff::{
    Attitude, Belief, BeliefGrid, Capabilities, ChemicalReading, Estimate, FlowEstimate, GuidanceStatus, Observation,
    Setpoint,
};

#[allow(dead_code, reason = "some of it serves the other crate only")]
#[path = "../../src/handoff/testing.rs"]
mod kit;

pub(crate) use kit::{area, block, seen, smelling};
