//! Filaments: store, drift, concentration.
//!
//! Each folder knows only those before it: `store`, `water`, `walls`, then `drift` and `query`, which do not know each
//! other. The files beside them are the plume itself.

mod displaced;
mod drift;
mod plume;
mod query;
mod step;
mod store;
mod tally;
#[cfg(test)]
mod tests;
mod walls;
mod water;

pub use crate::simd::dispatch::instructions;
pub use displaced::DisplacedConcentration;
pub use drift::longest_step::{EVEN, SharpestMixing, Uneven, examined};
pub use plume::{Plume, PlumeSettings};
pub use query::index::CUT_SIGMAS;
pub use step::threads;
pub use walls::cut_off::cut_off;
