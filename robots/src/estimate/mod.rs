//! Turns readings into what the vehicle believes. One file per estimator.

mod catalogue;
mod dead_reckoning;
mod estimator;
mod layers;
#[cfg(test)]
mod with_instruments;

pub use catalogue::CATALOGUE;
pub use dead_reckoning::{DeadReckoning, DeadReckoningSpec, Start};
pub use estimator::EstimatorSpec;
pub use layers::LayerAwareSpec;
