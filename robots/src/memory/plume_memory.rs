//! What the behaviours of a vehicle remember together: the flow, the last detection, and where the plume was lost.
//!
//! *Source*: Pang 2009, section 5.3 (lost points); Tian et al. 2013, section 3 (LCDP queue).
//!
//! *Parameters*: most lost points, 6 in Pang 2009; most last detection points, [`LCDPS`].
//!
//! *Deviations*: in the papers a navigation fix moves no remembered place; [`FixMove`] lists what can be done.

use super::{FixMove, FixWatch, LcdpQueue, LostPoints, NavigationFix};
use crate::handoff::{Lcdp, Observation, Side, detects};
use nalgebra::Vector2;
use std::num::NonZeroUsize;
use world::units::Heading;

/// What the behaviours know in common.
#[derive(Clone, Debug, PartialEq)]
pub struct PlumeMemory {
    /// Up-flow by the newest flow estimate; `None` until a flow has been measured.
    pub up_flow: Option<Heading>,
    /// The newest detection that the strategy acted on.
    pub last_detection: Option<Lcdp>,
    /// The side on which the vehicle is expected to leave the plume (LHS = +1: left).
    pub leaves: Side,
    /// Where the plume was lost: a short list that the reacquisition works through.
    pub lost: LostPoints,
    /// Every place where the plume was lost in this mission; declaration rules read it.
    pub lcdps: LcdpQueue,
    /// The navigation fixes so far.
    pub fixes: FixWatch,
    /// Bits of the flow of `up_flow`: a flow is measured more seldom than asked for.
    pub(crate) flow: Option<Vector2<u64>>,
}

/// The longest queue of last detection points if a scenario gives none: more than one point in 8 s for 2 h.
pub const LCDPS: NonZeroUsize = NonZeroUsize::new(1000).expect("1000 is not zero");

impl Default for PlumeMemory {
    fn default() -> Self {
        // Pang 2009, section 5.3: six lost points.
        Self::new(NonZeroUsize::new(6).expect("6 is not zero"), LCDPS)
    }
}

impl PlumeMemory {
    /// An empty memory with room for `lost` lost points and `lcdps` last detection points.
    pub fn new(lost: NonZeroUsize, lcdps: NonZeroUsize) -> Self {
        Self {
            up_flow: None,
            last_detection: None,
            leaves: Side::Left,
            lost: LostPoints::new(lost),
            lcdps: LcdpQueue::new(lcdps),
            fixes: FixWatch::default(),
            flow: None,
        }
    }

    /// Takes in the flow of a tick.
    pub fn take_flow(&mut self, seen: &Observation) {
        if let Some(flow) = seen.estimate.flow {
            let bits = flow.velocity.map(f64::to_bits);
            if self.flow.replace(bits) != Some(bits) {
                self.up_flow = Some(flow.up_flow());
            }
        }
    }

    /// Takes in a tick: its flow, a fix by `rule`, and a detection if that is `heeded`; true on such a detection.
    pub fn observe(&mut self, seen: &Observation, rule: FixMove, heeded: bool) -> bool {
        self.take_flow(seen);
        if let Some(fix) = self.fixes.observe(&seen.estimate) {
            self.take_fix(&fix, rule);
        }
        let detected = heeded && detects(seen);
        if detected {
            self.last_detection = Some(Lcdp::here(seen));
        }
        detected
    }

    /// The plume was lost at `point`.
    pub fn lose(&mut self, point: Lcdp, up_flow: Heading) {
        self.lost.add(point, up_flow);
        self.lcdps.add(point);
    }

    /// Forgets the places within a distance of `place` where the plume was lost.
    pub fn forget_near(&mut self, place: Vector2<f64>, within_m: f64) {
        for points in [&mut self.lost.points, &mut self.lcdps.points] {
            points.retain(|p| (p.position - place).norm() > within_m);
        }
    }

    /// A navigation fix has moved the believed position: moves the remembered places by the rule.
    pub(crate) fn take_fix(&mut self, fix: &NavigationFix, rule: FixMove) {
        let lost = self.lost.points.iter_mut().chain(&mut self.lcdps.points);
        for point in lost.chain(&mut self.last_detection) {
            point.position += fix.shift_of(point.t_s, rule);
        }
    }

    /// Up-flow, or the vehicle's heading as long as no flow is known.
    pub fn up_flow_or_nose(&self, seen: &Observation) -> Heading {
        self.up_flow.unwrap_or(seen.estimate.attitude.heading)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;

    #[test]
    fn forgets_what_is_near_a_place() {
        let mut memory = PlumeMemory::default();
        for (t_s, north) in [(1.0, 15.0), (2.0, 20.0)] {
            memory.lose(Lcdp::new_at(t_s, Vector2::new(0.0, north)), Heading::from_deg(0.0));
        }
        memory.forget_near(Vector2::new(0.0, 12.0), 4.0);
        for points in [memory.lost.all(), memory.lcdps.all()] {
            assert_eq!(points.iter().map(|p| p.t_s).collect::<Vec<_>>(), [2.0]);
        }
    }

    #[test]
    fn a_fix_moves_all_that_is_remembered() {
        let up = Heading::from_deg(0.0);
        for (rule, old, new) in [(FixMove::Stay, 0.0, 0.0), (FixMove::Share, 2.5, 7.5), (FixMove::Whole, 10.0, 10.0)] {
            let mut memory = PlumeMemory::default();
            let mut o = seen(0.0, Vector2::zeros(), 0.0, None);
            memory.observe(&o, rule, false);
            memory.lose(Lcdp::new_at(10.0, Vector2::zeros()), up);
            memory.last_detection = Some(Lcdp::new_at(30.0, Vector2::zeros()));
            // The fix at 40 s moves the vehicle by 10 m since the start at 0 s.
            o.estimate.t_s = 40.0;
            o.estimate.fix_jump = Vector2::new(10.0, 0.0);
            memory.observe(&o, rule, false);
            let east = |l: Option<Lcdp>| l.expect("a point").position.x;
            assert_eq!(east(memory.lost.first()), old, "{rule:?}");
            assert_eq!(east(memory.lcdps.newest()), old, "{rule:?}");
            assert_eq!(east(memory.last_detection), new, "{rule:?}");
        }
    }
}
