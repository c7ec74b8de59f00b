//! A decision with what its strategy shows then.

use super::Strategy;
use crate::handoff::{Decision, Observation, Shown};
use std::ops::Deref;
use world::seeds::Stream;

/// A strategy's tick. It is read like the decision.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticked {
    decision: Decision,
    pub(crate) shown: Shown,
}

impl Ticked {
    /// One tick of a strategy.
    pub(crate) fn step(strategy: &mut dyn Strategy, seen: &Observation, rng: &mut Stream) -> Self {
        let decision = strategy.step(seen, rng);
        Self { decision, shown: strategy.shown() }
    }
}

impl Deref for Ticked {
    type Target = Decision;

    fn deref(&self) -> &Decision {
        &self.decision
    }
}
