//! Surface waves: one component, a spectrum divided into components, and the sea that they form.

mod airy;
mod sea;
mod spec;
mod spectrum;
#[cfg(test)]
pub(crate) mod tests;

pub use sea::Waves;
pub use spec::{TrainSpec, WavesSpec};
pub use spectrum::SpectrumSpec;
