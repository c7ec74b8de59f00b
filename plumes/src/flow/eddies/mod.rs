//! Resolved turbulence of a channel: its spectrum, one long stretch of it, and how it moves and decays.

mod eddy_field;
mod field;
mod fourier;
mod lazy_stretch;
mod small;
mod spectrum;
mod stretch;
#[cfg(test)]
pub(crate) mod tests_eddies;

pub use field::{Eddies, EddiesSpec};
#[cfg(test)]
pub(crate) use small::tests as tests_small;
pub(crate) use small::{Life, MOST_OCTAVES, Weights};
pub use small::{Small, SmallSpec};
pub use spectrum::Spectrum;
