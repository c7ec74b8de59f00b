//! Goes back to the launch point.
//!
//! *Source*: Pang 2009, section 4.1 ("return to home location after the vehicle finish its mission").
//!
//! *Parameters*: none; home is the vehicle's own first position.
//!
//! *Deviations*: none.

use super::{Behave, Stride};
use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use world::seeds::Stream;

/// State of the way home.
#[derive(Clone, Copy, Debug, Default)]
pub struct GoHome {
    begun: bool,
}

impl Behave for GoHome {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.begun = false;
    }

    fn step(&mut self, seen: &Observation, arrived: bool, _: &mut PlumeMemory, _: &mut Stream) -> Stride {
        if !self.begun {
            self.begun = true;
            return Stride::Start(Manoeuvre::GoToPoint { point: seen.home, radius_m: None });
        }
        if arrived { Stride::Over } else { Stride::Keep }
    }
}
