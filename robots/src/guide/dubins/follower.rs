//! Steers along a Dubins path and plans a new one when a navigation fix moves the vehicle off it.
//!
//! *Source*: Pang 2009, section 4.3 (the path); the tracking law is that of Follow Line, eq. 8, with the path's
//! tangent in place of the line's direction.
//!
//! *Parameters*: gain and capture angle as in Follow Line; `replan_m`, m, 8; radius `turn_radius_m`, m, 15.
//!
//! *Deviations*: the paper does not say how the path is tracked. Here the place on the path only moves forward, by at
//! most 20 m at once, so that a crossing of the path with itself is not taken for progress. The mode ends at the
//! path's end even if place or heading were missed, and at the latest after three times the first path's duration
//! plus a minute (however often it was planned again), so that it never circles for ever.

use super::arc::Pose;
use super::path::DubinsPath;
use crate::guide::spec::GuidanceSpec;
use nalgebra::Vector2;
use world::units::Heading;

/// How far the place on the path may move forward in a step, m: a navigation fix and a margin.
const WINDOW_M: f64 = 20.0;
/// Time added to three times the first path's duration, s.
const GRACE_S: f64 = 60.0;
/// The vehicle takes the path's tangent this far ahead, s, to compensate its own lag.
const LOOK_AHEAD_S: f64 = 0.5;

/// State of following a path.
#[derive(Clone, Copy, Debug)]
pub(in crate::guide) struct Follower {
    end: Pose,
    path: DubinsPath,
    s_m: f64,
    /// Pose of the path there.
    foot: Pose,
    left_s: f64,
}

impl Follower {
    /// Plans the first path.
    pub(in crate::guide) fn new(from: Pose, end: Pose, speed_m_s: f64, spec: &GuidanceSpec) -> Self {
        let path = DubinsPath::shortest(from, end, spec.turn_radius_m.get());
        Self {
            end,
            path,
            s_m: 0.0,
            foot: path.pose_at(0.0),
            left_s: 3.0 * path.length_m() / speed_m_s.max(0.1) + GRACE_S,
        }
    }

    /// Course to take, and whether the path (or the time for it) has ended; `moving` gives the course over ground.
    pub(in crate::guide) fn step(
        &mut self,
        spec: &GuidanceSpec,
        position: Vector2<f64>,
        moving: impl FnOnce() -> Heading,
        speed_m_s: f64,
        dt_s: f64,
    ) -> (Heading, bool) {
        self.left_s -= dt_s;
        let before = (self.s_m, self.foot);
        (self.s_m, self.foot) = (self.path).nearest(position, before, self.s_m + WINDOW_M);
        if (self.foot.position - position).norm() > spec.replan_m.get() {
            let at = Pose { position, heading: moving() };
            self.path = DubinsPath::shortest(at, self.end, spec.turn_radius_m.get());
            self.s_m = 0.0;
            self.foot = self.path.pose_at(0.0);
        }
        // Positive to the left of the path.
        let off_m = self.path.unit(self.foot.heading).perp(&(position - self.foot.position));
        let ahead = self.path.heading(self.s_m + LOOK_AHEAD_S * speed_m_s);
        let at_end = self.s_m >= self.path.length_m() - 0.5;
        (ahead.turned(spec.turn_to_line(off_m)), at_end || self.left_s <= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Drives a vehicle limited to 10 deg/s at 2 m/s; returns (pose at the end, steps, finished).
    fn drive(start: Pose, end: Pose, jumps: &[(usize, Vector2<f64>)]) -> (Pose, usize, bool) {
        let mut f = Follower::new(start, end, 2.0, &GuidanceSpec::default());
        let mut at = start;
        for k in 0..20_000 {
            for (when, by) in jumps {
                if *when == k {
                    at.position += by;
                }
            }
            let (want, done) = f.step(&GuidanceSpec::default(), at.position, || at.heading, 2.0, 0.1);
            if done {
                return (at, k, true);
            }
            let most = 10f64.to_radians() * 0.1;
            at.heading = at.heading.turned(at.heading.turn_to(want).clamp(-most, most));
            at.position += at.heading.unit() * 0.2;
        }
        (at, 20_000, false)
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn arrives_with_the_heading(
            e in -80.0..80.0, n in -80.0..80.0, h1 in 0.0..360.0, h2 in 0.0..360.0,
        ) {
            let start = Pose { position: Vector2::zeros(), heading: Heading::from_deg(h1) };
            let end = Pose { position: Vector2::new(e, n), heading: Heading::from_deg(h2) };
            let (at, _, done) = drive(start, end, &[]);
            prop_assert!(done);
            prop_assert!((at.position - end.position).norm() < 3.0, "{at:?}");
            prop_assert!(at.heading.turn_to(end.heading).abs() < 15f64.to_radians());
        }

        #[test]
        fn fixes_do_not_make_it_circle(
            e in -80.0..80.0, n in -80.0..80.0, h2 in 0.0..360.0,
            k1 in 0usize..400, k2 in 0usize..400, j1 in 0.0..360.0, j2 in 0.0..360.0,
        ) {
            let start = Pose { position: Vector2::zeros(), heading: Heading::from_deg(0.0) };
            let end = Pose { position: Vector2::new(e, n), heading: Heading::from_deg(h2) };
            let jumps = [(k1, Heading::from_deg(j1).unit() * 10.0), (k2, Heading::from_deg(j2).unit() * 10.0)];
            let (_, steps, done) = drive(start, end, &jumps);
            let first = DubinsPath::shortest(start, end, 15.0).length_m();
            prop_assert!(done && steps as f64 * 0.1 <= 3.0 * first / 2.0 + GRACE_S + 0.2);
        }
    }
}
