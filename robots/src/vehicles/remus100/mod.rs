//! The REMUS 100: its URDF, its numbers and its terms of the equation of motion.

mod actuators;
mod coefficients;
mod terms;
#[cfg(test)]
mod tests;

pub use actuators::Actuators;
pub use coefficients::{Coefficients, Inflow, ParameterSet};
pub(super) use terms::RemusTerms;

/// The built-in URDF's name for messages, and its text.
pub(super) const REMUS100: (&str, &str) = ("remus100.urdf", include_str!("../../../urdf/remus100.urdf"));
