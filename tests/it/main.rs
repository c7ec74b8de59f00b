//! What holds: one test binary.

mod autopilot;
mod bad_input;
mod campaign;
mod common;
mod determinism;
mod flume;
mod golden;
mod interrupt;
mod live;
mod planning;
mod reproduce;
mod scenarios;
mod segment;
mod spin_up;
mod structure;
mod vehicle;
mod vehicle_effects;
