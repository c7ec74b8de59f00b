//! Policies: which way to go next, by a belief about the source. One file each.

mod catalogue;
mod choice;
mod dcee;
mod dual;
mod entrotaxis;
mod greedy;
mod infotaxis;
#[cfg(test)]
mod lattice_tests;
#[cfg(test)]
mod plume_tests;
mod prospect;
mod qmdp;
mod space_aware;
mod thompson;

pub use catalogue::{Policies, PolicySpec};
pub use choice::{Policy, PolicyParams};
pub use dcee::Dcee;
pub use dual::Dual;
pub use entrotaxis::Entrotaxis;
pub use greedy::Greedy;
pub use infotaxis::Infotaxis;
pub use prospect::{BeliefAfter, PathOutcome, Prospect, Way};
pub use qmdp::Qmdp;
pub use space_aware::SpaceAware;
pub use thompson::Params as ThompsonParams;
