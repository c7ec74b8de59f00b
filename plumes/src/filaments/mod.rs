//! Filaments: store, drift, concentration.

mod bands;
mod batch;
mod boxes;
mod clearances;
mod contribution;
mod cut_off;
mod displaced;
mod domain;
mod drift_band;
mod eddy_coordinates;
mod evenness;
mod fetch;
mod group;
mod image;
mod index;
mod kernel;
mod longest_step;
mod lookup;
mod moving_packet;
mod noise;
mod open_place;
mod order;
mod packet;
mod plume;
mod pollock;
mod question;
mod rebound;
mod rise;
mod rows;
mod run_bounds;
mod sampled;
mod scan;
mod series;
mod size;
mod small_eddies;
mod solids;
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

pub use crate::simd::dispatch::instructions;
pub use cut_off::cut_off;
pub use displaced::DisplacedConcentration;
pub use index::CUT_SIGMAS;
pub use longest_step::{EVEN, SharpestMixing, Uneven, examined};
pub use plume::{Plume, PlumeSettings};
pub use step::threads;
