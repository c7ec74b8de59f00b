//! Filaments: store, drift, concentration.

mod bands;
mod boxes;
mod carried;
mod crowd;
mod cut_off;
mod displaced;
mod evenness;
mod felt;
mod fetch;
mod group;
mod image;
mod index;
mod kernel;
mod labels;
mod leaf;
mod longest_step;
mod lookup;
mod moving;
mod noise;
mod open_place;
mod order;
mod plume;
mod rebound;
mod rise;
mod room;
mod rows;
mod sampled;
mod scan;
mod series;
mod side;
mod size;
mod solids;
mod step;
mod store;
mod sweep;
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

pub use crate::path::instructions;
pub use cut_off::cut_off;
pub use displaced::Displaced;
pub use index::CUT_SIGMAS;
pub use longest_step::{EVEN, SharpestMixing, Uneven, examined};
pub use plume::{Plume, PlumeSettings};
pub use step::threads;
