//! What every mapper does.

use super::watch::MapObservation;
use crate::error::RobotError;
use crate::handoff::{Belief, Outlook, WaysAhead};
use world::area::Area;
use world::cost::{Cost, Times};
use world::registry::Spec;
use world::seeds::Stream;

/// A mapper: takes in one observation per tick and holds a belief.
pub trait Mapper: std::fmt::Debug + Send + Sync {
    /// One tick.
    fn step(&mut self, seen: &MapObservation);
    /// The present belief.
    fn belief(&self) -> &Belief;
    /// What it expects on ways ahead; `None` if it knows no flow yet, or if it does not look ahead.
    fn outlook(&mut self, _ways: &WaysAhead) -> Option<Outlook> {
        None
    }
    /// Logarithm of the probability that the map gave to all that it has observed so far, up to a constant that is the
    /// same for maps of the same kind; 0 if it does not know.
    fn ln_evidence(&self) -> f64 {
        0.0
    }
}

/// Parameters of a mapper.
pub trait MapParams: Spec {
    /// Builds the mapper; `rng` is the robot's own stream for its map.
    ///
    /// # Errors
    /// [`RobotError::Invalid`], with the field below `map`.
    fn build(&self, area: &Area, rng: Stream) -> Result<Box<dyn Mapper>, RobotError>;

    /// Checks that the mapper can hold so many cells and such a look-back, without building anything.
    ///
    /// # Errors
    /// [`RobotError::Invalid`], with the field below `map`.
    fn check(&self, area: &Area) -> Result<(), RobotError>;

    /// Whether its mapper says what it expects on ways ahead ([`Mapper::outlook`]).
    fn looks_ahead(&self) -> bool {
        false
    }

    /// Its memory and time; paths below `map`.
    fn cost(&self, _times: &Times) -> Cost {
        Cost::default()
    }
}
