//! Filaments: store, drift, concentration.

mod cells;
mod displaced;
mod index;
mod kernel;
mod leaf;
mod lookup;
mod noise;
mod plume;
pub(crate) mod quad;
mod size;
mod solids;
mod store;
#[cfg(test)]
mod tests_drift;
#[cfg(test)]
mod tests_flume;
#[cfg(test)]
mod tests_mass;
#[cfg(test)]
mod tests_mean;
#[cfg(test)]
mod tests_mixed;
#[cfg(test)]
mod tests_round;
#[cfg(test)]
mod tests_water;
#[cfg(test)]
mod tests_waves;
mod thread;
mod walls;

pub use displaced::Displaced;
pub use index::CUT_SIGMAS;
pub use plume::{Plume, PlumeSettings};
