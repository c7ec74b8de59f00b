//! Resolved turbulence of a channel: spectrum, one long stretch of it, and how it passes and dies.

mod field;
mod fourier;
mod spectrum;
mod stretch;
#[cfg(test)]
#[path = "tests_eddies.rs"]
pub(crate) mod tests;

pub use field::{Eddies, EddiesSpec};
pub use spectrum::Spectrum;
