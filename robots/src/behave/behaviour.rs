//! What every behaviour does: it looks at an observation and answers with a goal.
//!
//! *Source*: this project's own.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use crate::error::RobotError;
use crate::handoff::{Goal, Manoeuvre, Need, Observation, Vertical};
use crate::memory::PlumeMemory;
use std::fmt::Debug;
use world::registry::Spec;
use world::seeds::Stream;

/// What a behaviour answers in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stride {
    /// A new goal.
    Start(Manoeuvre),
    /// The same goal with a new course.
    Adjust(Manoeuvre),
    /// The same goal.
    Keep,
    /// The behaviour has ended.
    Over,
}

impl Stride {
    /// Changes the goal by it; a new goal is at that height.
    pub(crate) fn turn(self, goal: &mut Goal, vertical: Vertical) {
        match self {
            Self::Start(manoeuvre) => *goal = Goal { id: goal.id + 1, manoeuvre, vertical, ..*goal },
            Self::Adjust(manoeuvre) => goal.manoeuvre = manoeuvre,
            Self::Keep | Self::Over => {}
        }
    }
}

/// A behaviour: a plain state machine with one purpose.
pub trait Behave: Debug + Send + Sync {
    /// Starts afresh; the next step answers [`Stride::Start`] or [`Stride::Over`].
    fn enter(&mut self, seen: &Observation, memory: &PlumeMemory);

    /// One tick. `arrived` says whether the guidance has reached the last goal.
    fn step(&mut self, seen: &Observation, arrived: bool, memory: &mut PlumeMemory, rng: &mut Stream) -> Stride;
}

/// Parameters of a behaviour.
pub trait BehaviourParams: Spec {
    /// Builds the behaviour.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if a parameter makes no sense.
    fn build(&self) -> Result<Box<dyn Behave>, RobotError>;

    /// Its field that asks the vehicle to wait at a place, if it is set.
    fn waits(&self) -> Option<&'static str> {
        None
    }

    /// The instruments that it needs beside those of a search; paths below its field.
    fn needs(&self) -> Vec<Need> {
        Vec::new()
    }
}
