//! What a scenario says about a gantry's searcher.

use super::chemotaxis::{Chemotaxis, ChemotaxisSpec};
use super::crab::CrabTracker;
use super::crab_spec::CrabSpec;
use crate::error::RobotError;
use crate::handoff::{GantryDecision, GantryLayout, GantryObservation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::seeds::Stream;

/// A gantry's searcher: sees an observation a tick and decides where the head is to go.
pub trait GantryStrategy: std::fmt::Debug + Send + Sync {
    /// One tick.
    fn step(&mut self, seen: &GantryObservation, rng: &mut Stream) -> GantryDecision;
}

/// The searchers a scenario can ask for.
#[allow(
    clippy::large_enum_variant,
    reason = "one a run, and a box would only cost the reader"
)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum GantryStrategySpec {
    /// The blue-crab tracker.
    Crab(CrabSpec),
    /// Bilateral gradient climbing on averaged concentrations.
    Chemotaxis(ChemotaxisSpec),
}

impl GantryStrategySpec {
    /// The searcher on a machine, ready for its first tick.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] when the machine cannot do what the searcher asks of it.
    pub fn build(&self, layout: &GantryLayout) -> Result<Box<dyn GantryStrategy>, RobotError> {
        Ok(match self {
            Self::Crab(spec) => Box::new(CrabTracker::new(spec, layout)?),
            Self::Chemotaxis(spec) => Box::new(Chemotaxis::new(spec, layout)?),
        })
    }

    /// Name, as in the catalogue.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Crab(_) => "Crab",
            Self::Chemotaxis(_) => "Chemotaxis",
        }
    }
}
