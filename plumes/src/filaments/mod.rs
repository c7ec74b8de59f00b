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
mod tests_bands;
#[cfg(test)]
mod tests_datum;
#[cfg(test)]
mod tests_drift;
#[cfg(test)]
mod tests_even;
#[cfg(test)]
mod tests_even_obstacles;
#[cfg(test)]
mod tests_even_quay;
#[cfg(test)]
mod tests_evenness;
#[cfg(test)]
mod tests_flume;
#[cfg(test)]
mod tests_images;
#[cfg(test)]
mod tests_index;
#[cfg(test)]
mod tests_kept;
#[cfg(test)]
mod tests_mass;
#[cfg(test)]
mod tests_mean;
#[cfg(test)]
mod tests_mixed;
#[cfg(test)]
mod tests_one_water;
#[cfg(test)]
mod tests_round;
#[cfg(test)]
mod tests_water;
#[cfg(test)]
mod tests_waves;
mod walls;
mod water;

pub use crate::simd::dispatch::instructions;
pub use displaced::DisplacedConcentration;
pub use drift::longest_step::{EVEN, SharpestMixing, Uneven, examined};
pub use plume::{Plume, PlumeSettings};
pub use query::index::CUT_SIGMAS;
pub use step::threads;
pub use walls::cut_off::cut_off;
