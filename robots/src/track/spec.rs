//! What a scenario can say about a gantry's searcher.

use crate::error::RobotError;
use crate::handoff::{ExchangeTiming, GantryLayout, HeadGoal};
use crate::searcher::Strategy;
use world::registry::Spec;

/// Parameters of a gantry's searcher.
pub trait GantryStrategyParams: Spec {
    /// Builds the searcher for a machine.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the machine cannot do what the searcher needs.
    fn build(&self, layout: &GantryLayout) -> Result<Box<dyn Strategy<HeadGoal>>, RobotError>;

    /// If a searcher outside this program decides: how often it is asked.
    fn consulted(&self) -> Option<ExchangeTiming> {
        None
    }
}
