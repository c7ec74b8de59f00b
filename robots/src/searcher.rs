//! What every searcher is, whatever machine it decides for.

use crate::handoff::{Bounds, Decision, GantryObservation, Goal, HeadGoal, Observation, Shown, TrackerState};
use std::fmt::Debug;
use world::seeds::Stream;

/// What is asked of a kind of machine: a [`Goal`] of a vehicle, a [`HeadGoal`] of a gantry. What its searcher sees and
/// shows goes with it.
pub trait MachineGoal: Debug + Clone + Send + Sync + 'static {
    /// What a searcher sees in a tick.
    type Seen;
    /// What it shows of itself.
    type Shown: Default;

    /// What of a decision cannot be carried out or shown.
    fn fault(decision: &Decision<Self>, bounds: Bounds) -> Option<String>;
}

impl MachineGoal for Goal {
    type Seen = Observation;
    type Shown = Shown;

    fn fault(decision: &Decision<Self>, bounds: Bounds) -> Option<String> {
        decision.fault(bounds)
    }
}

impl MachineGoal for HeadGoal {
    type Seen = GantryObservation;
    type Shown = TrackerState;

    fn fault(decision: &Decision<Self>, bounds: Bounds) -> Option<String> {
        decision.fault(bounds)
    }
}

/// A strategy: takes one observation per tick and decides what to ask of its machine.
pub trait Strategy<G: MachineGoal = Goal>: Debug + Send + Sync {
    /// One tick.
    fn step(&mut self, seen: &G::Seen, rng: &mut Stream) -> Decision<G>;

    /// What it shows of itself; asked only when somebody looks.
    fn shown(&self) -> G::Shown {
        G::Shown::default()
    }
}
