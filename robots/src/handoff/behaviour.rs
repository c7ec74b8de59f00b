//! What a behaviour is, what it shares with the others and what it answers.

use super::{LostPoint, LostPoints, Manoeuvre, Observation};
use std::fmt::Debug;
use world::seeds::Stream;
use world::units::Heading;

/// A side, looking up-flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of up-flow.
    Left,
    /// Right of up-flow.
    Right,
}

impl Side {
    /// +1 to the right (clockwise), -1 to the left.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => -1.0,
            Side::Right => 1.0,
        }
    }

    /// The side of a signed distance or turn, right positive.
    #[must_use]
    pub fn of(rightward: f64) -> Self {
        if rightward < 0.0 {
            Side::Left
        } else {
            Side::Right
        }
    }

    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
}

/// What the behaviours know together.
#[derive(Clone, Debug, PartialEq)]
pub struct PlumeMemory {
    /// Up-flow by the newest flow estimate; `None` until a flow was measured.
    pub up_flow: Option<Heading>,
    /// The newest detection that was heeded.
    pub last_detection: Option<LostPoint>,
    /// The side on which the vehicle is expected to leave the plume (LHS = +1: left).
    pub leaves: Side,
    /// Where the plume was lost.
    pub lost: LostPoints,
}

impl PlumeMemory {
    /// Up-flow, or the vehicle's own heading as long as no flow is known.
    #[must_use]
    pub fn up_flow_or_nose(&self, seen: &Observation) -> Heading {
        self.up_flow.unwrap_or(seen.estimate.attitude.heading)
    }
}

/// What a behaviour answers in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stride {
    /// A new goal.
    Start(Manoeuvre),
    /// The same goal, its course changed.
    Adjust(Manoeuvre),
    /// The same goal.
    Keep,
    /// It has come to its end.
    Over,
}

/// A behaviour: a plain state machine with one purpose.
pub trait Behave: Debug + Send + Sync {
    /// Begins afresh; the next step answers [`Stride::Start`] or [`Stride::Over`].
    fn enter(&mut self, seen: &Observation, memory: &PlumeMemory);

    /// One tick. `arrived`: the guidance has reached the goal last given.
    fn step(
        &mut self,
        seen: &Observation,
        arrived: bool,
        memory: &mut PlumeMemory,
        rng: &mut Stream,
    ) -> Stride;
}

/// The chemical sensor reported a detection in this tick.
#[must_use]
pub fn detects(seen: &Observation) -> bool {
    seen.chemical.is_some_and(|c| c.detected)
}
