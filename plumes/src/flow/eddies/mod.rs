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

/// Numbers and weights of the two patterns of a sequence that overlap at a time, in half-lives: a pattern lives from its
/// number to two later. The weight of the older one falls, that of the younger one rises; their squares sum to 1.
fn overlapping(age: f64) -> [(f64, f64); 2] {
    let young = age.floor();
    let (s, c) = world::math::sin_cos(std::f64::consts::FRAC_PI_2 * (age - young));
    [(young - 1.0, c), (young, s)]
}
