//! What holds: one test binary.

mod autopilot;
mod bad_input;
mod common;
mod determinism;
mod live;
mod structure;
mod vehicle;
mod vehicle_effects;
