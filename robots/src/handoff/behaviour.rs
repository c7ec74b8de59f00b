//! What a behaviour is, what it shares with the others and what it answers.

use super::{FixMove, FixWatch, Lcdp, LcdpQueue, LostPoints, Manoeuvre, Observation};
use nalgebra::Vector2;
use std::fmt::Debug;
use std::num::NonZeroUsize;
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
    pub last_detection: Option<Lcdp>,
    /// The side on which the vehicle is expected to leave the plume (LHS = +1: left).
    pub leaves: Side,
    /// Where the plume was lost and is looked for again: a short list that the reacquisition works off.
    pub lost: LostPoints,
    /// Every place where it was lost in this mission: what a source is declared from.
    pub lcdps: LcdpQueue,
    /// The navigation fixes so far.
    pub fixes: FixWatch,
}

/// The longest queue of last detection points unless a scenario says otherwise: more than one in 8 s for 2 h.
pub const LCDPS: NonZeroUsize = NonZeroUsize::new(1000).expect("1000 is not zero");

impl Default for PlumeMemory {
    fn default() -> Self {
        // Pang 2009, section 5.3: six lost points.
        Self::new(NonZeroUsize::new(6).expect("6 is not zero"), LCDPS)
    }
}

impl PlumeMemory {
    /// Nothing known; room for so many lost points to work off, and so many last detection points in all.
    #[must_use]
    pub fn new(lost: NonZeroUsize, lcdps: NonZeroUsize) -> Self {
        Self {
            up_flow: None,
            last_detection: None,
            leaves: Side::Left,
            lost: LostPoints::new(lost),
            lcdps: LcdpQueue::new(lcdps),
            fixes: FixWatch::default(),
        }
    }

    /// The plume was lost at `point`.
    pub fn lose(&mut self, point: Lcdp, up_flow: Heading) {
        self.lost.add(point, up_flow);
        self.lcdps.add(point);
    }

    /// Forgets where the plume was lost within a distance of a place.
    pub fn forget_near(&mut self, place: Vector2<f64>, within_m: f64) {
        self.lost.forget_near(place, within_m);
        self.lcdps.forget_near(place, within_m);
    }

    /// Takes in the estimate of a tick: after a navigation fix the places remembered are moved by `rule`.
    pub fn take_fixes(&mut self, seen: &Observation, rule: FixMove) {
        let Some(fix) = self.fixes.observe(&seen.estimate) else {
            return;
        };
        if let Some(last) = &mut self.last_detection {
            last.position += fix.shift_of(last.t_s, rule);
        }
        self.lost.take_fix(&fix, rule);
        self.lcdps.take_fix(&fix, rule);
    }

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;
    use nalgebra::Vector2;

    #[test]
    fn a_fix_moves_all_that_is_remembered() {
        let up = Heading::from_deg(0.0);
        for (rule, old, new) in [
            (FixMove::Stay, 0.0, 0.0),
            (FixMove::Share, 2.5, 7.5),
            (FixMove::Whole, 10.0, 10.0),
        ] {
            let mut memory = PlumeMemory::default();
            let mut o = seen(0.0, Vector2::zeros(), 0.0, None);
            memory.take_fixes(&o, rule);
            memory.lose(Lcdp::at(10.0, Vector2::zeros()), up);
            memory.last_detection = Some(Lcdp::at(30.0, Vector2::zeros()));
            // The fix at 40 s moves the vehicle by 10 m since the start at 0 s.
            o.estimate.t_s = 40.0;
            o.estimate.fix_jump = Vector2::new(10.0, 0.0);
            memory.take_fixes(&o, rule);
            let east = |l: Option<Lcdp>| l.expect("a point").position.x;
            assert_eq!(east(memory.lost.first()), old, "{rule:?}");
            assert_eq!(east(memory.lcdps.newest()), old, "{rule:?}");
            assert_eq!(east(memory.last_detection), new, "{rule:?}");
        }
    }
}
