//! What every declaration rule does.

use crate::error::{RobotError, require};
use crate::handoff::{Belief, Declaration, Evidence, Lcdp, Zone};
use crate::memory::PlumeMemory;
use nalgebra::{Vector2, Vector3};
use std::num::NonZeroUsize;
use world::registry::Spec;
use world::units::Heading;

/// The points that a rule looks at, where the plume was lost, by their field in the strategy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// The short list of lost points.
    Lost,
    /// All last detection points.
    Lcdps,
}

impl Points {
    /// Those points of a searcher.
    pub fn select(self, memory: &PlumeMemory) -> &[Lcdp] {
        match self {
            Points::Lost => memory.lost.all(),
            Points::Lcdps => memory.lcdps.all(),
        }
    }
}

/// A rule that looks at the points where the plume was lost. Its parameters are its whole state.
pub trait DeclareParams: Spec {
    /// The points it looks at.
    fn points(&self) -> Points {
        Points::Lcdps
    }

    /// The least number of points that it needs.
    fn needs(&self) -> NonZeroUsize;

    /// The source's place (east, north), m, and its evidence, if the points show it.
    fn identify(&self, memory: &PlumeMemory, up_flow: Heading) -> Option<(Vector2<f64>, Evidence)>;

    /// What it looks at, for whoever watches; empty if there are too few points.
    fn zone(&self, _memory: &PlumeMemory, _up_flow: Heading) -> Zone {
        Zone::default()
    }

    /// Checks its parameters.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if bounds contradict each other.
    fn check_own(&self) -> Result<(), RobotError> {
        Ok(())
    }

    /// A declaration made at `t_s`, with the points it rests on.
    fn declaration(&self, t_s: f64, memory: &PlumeMemory, up_flow: Heading) -> Option<Declaration> {
        let (place, evidence) = self.identify(memory, up_flow)?;
        Some(Declaration { evidence: Some(evidence), ..Declaration::first(t_s, place, self.entry().name) })
    }

    /// Checks the parameters for a searcher that remembers so many lost points and last detection points.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if bounds contradict each other, or if the rule needs more points than the searcher
    /// remembers.
    fn check(&self, lost_points: NonZeroUsize, lcdps: NonZeroUsize) -> Result<(), RobotError> {
        let (most, list) = match self.points() {
            Points::Lost => (lost_points, "lost_points"),
            Points::Lcdps => (lcdps, "lcdps"),
        };
        let points = self.needs();
        require(
            points <= most,
            format!("declare.{}.points", self.entry().name),
            format!("must be at most {list}, {most}, got {points}: it would never declare"),
        )?;
        self.check_own()
    }
}

/// State of a rule on a map.
pub trait BeliefRule: std::fmt::Debug + Send + Sync {
    /// The source's place (ENU, m), if the map shows it at `t_s`.
    fn step(&mut self, t_s: f64, belief: &Belief) -> Option<Vector3<f64>>;
}

/// Parameters of a rule on a map.
pub trait BeliefRuleParams: Spec {
    /// Builds the rule before its first tick.
    fn build(&self) -> Box<dyn BeliefRule>;
}
