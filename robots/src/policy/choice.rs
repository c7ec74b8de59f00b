//! What every policy does: it chooses one of several ways by a belief about the source.

use super::prospect::Prospect;
use std::fmt::Debug;
use world::registry::Spec;
use world::seeds::Stream;

/// A policy.
pub trait Policy: Debug + Send + Sync {
    /// The number of the way to go.
    fn choose(&mut self, prospect: &Prospect<'_>, rng: &mut Stream) -> usize;
}

/// Parameters of a policy.
pub trait PolicyParams: Spec {
    /// The policy before its first choice.
    fn build(&self) -> Box<dyn Policy>;
}
