//! What a scenario says about the strategy.

use super::amp::{Amp, AmpSpec};
use super::map_and_plan::{MapAndPlan, MapAndPlanSpec};
use super::open_loop::{OpenLoop, OpenLoopSpec};
use super::subregions::{Subregions, SubregionsSpec};
use super::subsumption::{Subsumption, SubsumptionSpec};
use crate::error::RobotError;
use crate::handoff::{Decision, Observation, Setting, Vertical};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{NonNegative, Positive};
use world::seeds::Stream;

/// A strategy: sees an observation a tick and decides what to ask of the guidance.
pub trait Strategy: std::fmt::Debug + Send + Sync {
    /// One tick.
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision;
}

/// The strategies a scenario can ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum StrategySpec {
    /// Pang's adaptive mission planner: find, track in, track out, reacquire, declare.
    Amp(AmpSpec),
    /// A map of the source, and planned paths to its likeliest cell.
    MapAndPlan(MapAndPlanSpec),
    /// Tian's subsumption planner: the same behaviours as layers that suppress and inhibit each other.
    Subsumption(SubsumptionSpec),
    /// Actuators from a time table.
    OpenLoop(OpenLoopSpec),
    /// One subregion after the other, each searched by another strategy.
    Subregions(SubregionsSpec),
}

impl StrategySpec {
    /// It needs a forward ranging on board.
    #[must_use]
    pub fn needs_ranging(&self) -> bool {
        match self {
            StrategySpec::Subsumption(spec) => spec.needs_ranging(),
            StrategySpec::Subregions(spec) => spec.search.needs_ranging(),
            StrategySpec::Amp(_) | StrategySpec::MapAndPlan(_) | StrategySpec::OpenLoop(_) => false,
        }
    }

    /// Whether it flies passes for sidescan and camera after a declaration.
    #[must_use]
    pub fn flies_for(&self) -> [bool; 2] {
        match self {
            StrategySpec::Amp(spec) => spec.after_declaration.flies_for(),
            StrategySpec::Subsumption(spec) => {
                let [sidescan, camera] = spec.survey.as_ref().map_or([false; 2], |s| s.flies_for());
                [sidescan, camera || spec.eyes.is_some()]
            }
            StrategySpec::Subregions(spec) => spec.search.flies_for(),
            StrategySpec::MapAndPlan(_) | StrategySpec::OpenLoop(_) => [false; 2],
        }
    }

    /// That what it plans in is no more than a planner can have, without making any of it.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] when it is.
    pub fn check(&self, setting: &Setting) -> Result<(), RobotError> {
        match self {
            StrategySpec::MapAndPlan(spec) => spec.check(setting),
            StrategySpec::Subregions(spec) => spec.search.check(setting),
            StrategySpec::Amp(_) | StrategySpec::Subsumption(_) | StrategySpec::OpenLoop(_) => {
                Ok(())
            }
        }
    }

    /// The strategy, ready for its first tick.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] when fields contradict each other.
    pub fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(match self {
            StrategySpec::Amp(spec) => Box::new(Amp::new(spec)?),
            StrategySpec::MapAndPlan(spec) => Box::new(MapAndPlan::new(spec, setting)?),
            StrategySpec::Subsumption(spec) => Box::new(Subsumption::new(spec, setting)?),
            StrategySpec::OpenLoop(spec) => Box::new(OpenLoop::new(spec)?),
            StrategySpec::Subregions(spec) => Box::new(Subregions::new(spec, setting)?),
        })
    }
}

/// Vertical part of a strategy's goals.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum VerticalSpec {
    /// Height above the bed, m.
    Altitude(Positive),
    /// Depth below the surface, m.
    Depth(NonNegative),
}

impl From<VerticalSpec> for Vertical {
    fn from(v: VerticalSpec) -> Self {
        match v {
            VerticalSpec::Altitude(m) => Vertical::Altitude(m.get()),
            VerticalSpec::Depth(m) => Vertical::Depth(m.get()),
        }
    }
}
