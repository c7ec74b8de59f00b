//! What every searcher of a gantry does.

use crate::error::RobotError;
use crate::handoff::{ExchangeTiming, GantryDecision, GantryLayout, GantryObservation};
use world::registry::Spec;
use world::seeds::Stream;

/// A gantry's searcher: takes one observation per tick and decides where the head is to go.
pub trait GantryStrategy: std::fmt::Debug + Send + Sync {
    /// One tick.
    fn step(&mut self, seen: &GantryObservation, rng: &mut Stream) -> GantryDecision;
}

/// Parameters of a gantry's searcher.
pub trait GantryStrategyParams: Spec {
    /// Builds the searcher for a machine.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the machine cannot do what the searcher needs.
    fn build(&self, layout: &GantryLayout) -> Result<Box<dyn GantryStrategy>, RobotError>;

    /// If a searcher outside this program decides: how often it is asked.
    fn consulted(&self) -> Option<ExchangeTiming> {
        None
    }
}
