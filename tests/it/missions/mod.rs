//! Whole missions: what they find, that they repeat bit by bit, and what goes wrong in them.

mod abnormal;
mod determinism;
mod eyes;
mod faults;
mod flume;
mod golden;
mod memory;
mod ocean;
mod planning;
mod rejection;
mod scenarios;
mod score;
mod segment;
mod spin_up;
pub(super) mod subregions;
mod truth;
