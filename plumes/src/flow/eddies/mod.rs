//! Resolved turbulence of a channel: its spectrum, one long stretch of it, and how it moves and decays.

mod field;
mod fourier;
mod present;
mod spectrum;
mod stretch;
#[cfg(test)]
pub(crate) mod tests_eddies;

pub use field::{Eddies, EddiesSpec};
pub use spectrum::Spectrum;
