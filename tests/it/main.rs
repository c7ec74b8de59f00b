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
mod memory;
mod planning;
mod rejection;
mod reproduce;
mod scenarios;
mod sea;
mod segment;
mod spin_up;
mod structure;
mod subregions;
mod vehicle;
mod vehicle_effects;
