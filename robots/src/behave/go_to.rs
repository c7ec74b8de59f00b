//! Goes to a place, or home.
//!
//! *Source*: Pang 2009, section 5.1: "directly executes the Go-To guidance command". Home: section 4.1 ("return to home location after the
//! vehicle finish its mission").
//!
//! *Parameters*: the place; home is the vehicle's own first position.
//!
//! *Deviations*: none. The strategy decides whether detections count on the way.

use super::{Behave, Stride};
use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use nalgebra::Vector2;
use world::seeds::Stream;

/// State of going to a place.
#[derive(Clone, Copy, Debug)]
pub struct GoTo {
    /// `None` is home.
    point: Option<Vector2<f64>>,
    begun: bool,
}

impl GoTo {
    /// To `point` (east, north), m.
    pub fn new(point: Vector2<f64>) -> Self {
        Self { point: Some(point), begun: false }
    }

    /// To the launch point.
    pub fn home() -> Self {
        Self { point: None, begun: false }
    }
}

impl Behave for GoTo {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.begun = false;
    }

    fn step(&mut self, seen: &Observation, arrived: bool, _: &mut PlumeMemory, _: &mut Stream) -> Stride {
        if !self.begun {
            self.begun = true;
            return Stride::Start(Manoeuvre::GoToPoint { point: self.point.unwrap_or(seen.home), radius_m: None });
        }
        if arrived { Stride::Over } else { Stride::Keep }
    }
}
