//! A torpedo-shaped hull with terms of its own, such as the REMUS 100.

mod actuators;
mod coefficients;
mod hull;
mod spec;
mod terms;
#[cfg(test)]
pub(super) mod testing;
#[cfg(test)]
mod tests;

pub use coefficients::{Coefficients, Inflow};
pub(super) use hull::TorpedoHull;
pub use spec::{TorpedoFinsSpec, TorpedoHullSpec, TorpedoPropellerSpec};
