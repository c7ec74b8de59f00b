//! Surface waves: one component, a spectrum cut into components, and the sea they make.

mod airy;
mod sea;
mod spectrum;
#[cfg(test)]
pub(crate) mod tests;

pub use sea::{TrainSpec, Waves, WavesSpec};
pub use spectrum::SpectrumSpec;
