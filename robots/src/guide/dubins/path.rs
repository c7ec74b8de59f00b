//! The shortest curve-straight-curve path between two poses with a least turning radius.
//!
//! *Source*: Pang 2009, section 4.3; Dubins 1957 (American Journal of Mathematics 79).
//!
//! *Parameters*: turning radius R_m, `turn_radius_m`, m (not printed), 15.
//!
//! *Deviations*: none. As in the paper the CCC paths are left out, though one of them can be shorter for poses that
//! are near each other.

use super::arc::{Arc, Pose};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use world::math;
use world::units::{Heading, wrap_tau};

/// A path of two arcs joined by a straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DubinsPath {
    arcs: [Arc; 2],
    /// Lengths of arc, straight, arc, m.
    lengths_m: [f64; 3],
    /// Pose where the straight part begins.
    leave: Pose,
    /// Direction of the straight part, and its unit vector (east, north).
    course: Heading,
    along: Vector2<f64>,
    /// Pose at the end of the path.
    end: Pose,
}

impl DubinsPath {
    /// The shortest of the (up to four) candidates; the two whose arcs turn the same way always exist.
    pub fn shortest(start: Pose, end: Pose, radius_m: f64) -> Self {
        let mut best: Option<Self> = None;
        for first in [1.0, -1.0] {
            for second in [1.0, -1.0] {
                let Some(path) = Self::candidate(start, end, radius_m, [first, second]) else {
                    continue;
                };
                if best.is_none_or(|b| path.length_m() < b.length_m()) {
                    best = Some(path);
                }
            }
        }
        best.expect(
            "a path turning the same way twice exists between any two poses; a non-finite pose was given: \
            check the estimate",
        )
    }

    fn candidate(start: Pose, end: Pose, radius_m: f64, turns: [f64; 2]) -> Option<Self> {
        let first = Arc::new(start, turns[0], radius_m);
        let between = Arc::new(end, turns[1], radius_m).centre - first.centre;
        let distance_m = between.norm();
        if !distance_m.is_finite() {
            return None;
        }
        let (straight_m, course) = if turns[0] == turns[1] {
            // Outer tangent; concentric circles need no straight.
            let course = if distance_m < 1e-9 { start.heading } else { Heading::from_vector(between) };
            (distance_m, course)
        } else {
            if distance_m < 2.0 * radius_m {
                return None;
            }
            // Inner tangent: leans from the line of centres by asin(2r / d), to the side of the first turn.
            let lean = math::asin((2.0 * radius_m / distance_m).min(1.0));
            let straight = (distance_m * distance_m - 4.0 * radius_m * radius_m).max(0.0);
            (straight.sqrt(), Heading::from_vector(between).turned(turns[0] * lean))
        };
        let swept = |from: Heading, to: Heading, turn: f64| {
            let angle = wrap_tau(turn * (to.rad() - from.rad()));
            // Rounding must not turn no turn at all into a whole circle.
            if TAU - angle < 1e-9 { 0.0 } else { angle }
        };
        let lengths_m = [
            swept(start.heading, course, turns[0]) * radius_m,
            straight_m,
            swept(course, end.heading, turns[1]) * radius_m,
        ];
        let (leave, along) = (first.pose_at(lengths_m[0]), course.unit());
        let enter = Pose { position: leave.position + along * straight_m, heading: course };
        let mut path =
            Self { arcs: [first, Arc::new(enter, turns[1], radius_m)], lengths_m, leave, course, along, end: enter };
        path.end = path.pose_at(path.length_m());
        Some(path)
    }

    /// Whole length, m.
    pub fn length_m(&self) -> f64 {
        self.lengths_m.iter().sum()
    }

    /// Pose after `s_m` metres, held within the path.
    pub fn pose_at(&self, s_m: f64) -> Pose {
        let [a, b, c] = self.lengths_m;
        let s = s_m.clamp(0.0, a + b + c);
        if s <= a {
            self.arcs[0].pose_at(s)
        } else if s <= a + b {
            Pose { position: self.leave.position + self.along * (s - a), heading: self.course }
        } else {
            self.arcs[1].pose_at(s - a - b)
        }
    }

    /// Direction after `s_m` metres, held within the path.
    pub fn heading(&self, s_m: f64) -> Heading {
        let [a, b, c] = self.lengths_m;
        let s = s_m.clamp(0.0, a + b + c);
        if s <= a {
            self.arcs[0].heading(s)
        } else if s <= a + b {
            self.course
        } else {
            self.arcs[1].heading(s - a - b)
        }
    }

    /// Unit vector of a direction of the path (east, north).
    pub fn unit(&self, heading: Heading) -> Vector2<f64> {
        if heading == self.course { self.along } else { heading.unit() }
    }

    /// Place along the path, m, between `from_m` and `to_m`, that is nearest to `p`, and the pose there. `from` is the
    /// pose at `from_m`.
    pub fn nearest(&self, p: Vector2<f64>, (from_m, from): (f64, Pose), to_m: f64) -> (f64, Pose) {
        let [a, b, c] = self.lengths_m;
        let ends = [0.0, a, a + b, a + b + c];
        // Poses that are known need no sines.
        let pose = |s: f64| match s {
            s if s == from_m => from,
            s if s == a => self.leave,
            s if s == ends[3] => self.end,
            s => self.pose_at(s),
        };
        let mut best = (f64::INFINITY, from_m, from);
        for part in 0..3 {
            let (lo, hi) = (ends[part].max(from_m), ends[part + 1].min(to_m));
            if lo > hi {
                continue;
            }
            // The foot on an arc is known up to a whole circle; the ends cover what clamping misses.
            let foot = match part {
                0 => self.arcs[0].foot(p, a),
                1 => a + (p - self.leave.position).dot(&self.along),
                _ => a + b + self.arcs[1].foot(p, c),
            };
            let foot = foot.clamp(lo, hi);
            let others = [lo, hi].into_iter().filter(|s| *s != foot);
            for s in std::iter::once(foot).chain(others) {
                let at = pose(s);
                let d = (at.position - p).norm();
                if d < best.0 - 1e-12 {
                    best = (d, s, at);
                }
            }
        }
        (best.1, best.2)
    }
}

#[cfg(test)]
mod tests {
    use super::super::arc::side;
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn pose(east: f64, north: f64, deg: f64) -> Pose {
        Pose { position: Vector2::new(east, north), heading: Heading::from_deg(deg) }
    }

    /// The nearest place by all feet and all ends.
    fn plainly_nearest(path: &DubinsPath, p: Vector2<f64>, from_m: f64, to_m: f64) -> (f64, Pose) {
        let [a, b, c] = path.lengths_m;
        let feet = [
            path.arcs[0].foot(p, a),
            a + (p - path.leave.position).dot(&path.course.unit()),
            a + b + path.arcs[1].foot(p, c),
        ];
        let mut best = (f64::INFINITY, from_m);
        for (foot, (lo, hi)) in (feet.into_iter()).zip([(0.0, a), (a, a + b), (a + b, a + b + c)]) {
            let (lo, hi) = (f64::max(lo, from_m), f64::min(hi, to_m));
            if lo > hi {
                continue;
            }
            for s in [foot.clamp(lo, hi), lo, hi] {
                let d = (path.pose_at(s).position - p).norm();
                if d < best.0 - 1e-12 {
                    best = (d, s);
                }
            }
        }
        (best.1, path.pose_at(best.1))
    }

    #[test]
    fn straight_ahead_is_straight() {
        let end = Heading::from_deg(30.0).unit() * 100.0;
        let p = DubinsPath::shortest(pose(0.0, 0.0, 30.0), pose(end.x, end.y, 30.0), 15.0);
        assert!((p.length_m() - 100.0).abs() < 1e-6);
    }

    #[test]
    fn u_turn_by_hand() {
        // To a pose 60 m east facing back: quarter turns of 15 m and 30 m between them.
        let p = DubinsPath::shortest(pose(0.0, 0.0, 0.0), pose(60.0, 0.0, 180.0), 15.0);
        assert!((p.length_m() - (PI * 15.0 + 30.0)).abs() < 1e-9);
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn reaches_the_pose_without_a_break(
            e1 in -80.0..80.0, n1 in -80.0..80.0, h1 in 0.0..360.0,
            e2 in -80.0..80.0, n2 in -80.0..80.0, h2 in 0.0..360.0,
        ) {
            let (a, b) = (pose(e1, n1, h1), pose(e2, n2, h2));
            let path = DubinsPath::shortest(a, b, 15.0);
            let length = path.length_m();
            let end = path.pose_at(length);
            prop_assert!((end.position - b.position).norm() < 1e-6);
            prop_assert!(end.heading.turn_to(b.heading).abs() < 1e-6);
            let straight = (b.position - a.position).norm();
            prop_assert!(length >= straight - 1e-9);
            // Two whole circles and the way between two circle centres bound any CSC path.
            prop_assert!(length <= straight + 2.0 * 15.0 + 4.0 * PI * 15.0 + 1e-6);
            let n = 400;
            let step = length / f64::from(n);
            for i in 0..n {
                let (p, q) = (path.pose_at(f64::from(i) * step), path.pose_at(f64::from(i + 1) * step));
                prop_assert!((q.position - p.position).norm() <= step + 1e-9);
                prop_assert!(p.heading.turn_to(q.heading).abs() <= step / 15.0 + 1e-9);
            }
        }

        #[test]
        fn nearest_finds_points_of_the_path(
            e2 in -80.0..80.0, n2 in -80.0..80.0, h2 in 0.0..360.0, share in 0.0..1.0, aside in -3.0..3.0f64,
        ) {
            let path = DubinsPath::shortest(pose(0.0, 0.0, 10.0), pose(e2, n2, h2), 15.0);
            let s = share * path.length_m();
            let on = path.pose_at(s);
            let p = on.position + side(on.heading, 1.0) * aside;
            let from = (s - 5.0).max(0.0);
            let (found, there) = path.nearest(p, (from, path.pose_at(from)), s + 5.0);
            prop_assert!((there.position - p).norm() <= aside.abs() + 1e-9);
            prop_assert_eq!(there, path.pose_at(found));
        }

        #[test]
        fn what_is_known_of_a_path_leaves_the_nearest_place_as_it_is(
            e2 in -80.0..80.0, n2 in -80.0..80.0, h2 in 0.0..360.0,
            shares in prop::collection::vec(-0.1..1.1, 8), aside in -30.0..30.0f64, window in 0.0..60.0f64,
        ) {
            let path = DubinsPath::shortest(pose(0.0, 0.0, 10.0), pose(e2, n2, h2), 15.0);
            let [a, b, c] = path.lengths_m;
            let edges = [0.0, a, a + b, a + b + c];
            let places = shares.iter().map(|share: &f64| (share * (a + b + c)).max(0.0));
            for from in places.chain(edges) {
                let on = path.pose_at(from + 0.5 * window);
                let p = on.position + side(on.heading, 1.0) * aside;
                let found = path.nearest(p, (from, path.pose_at(from)), from + window);
                prop_assert_eq!(found, plainly_nearest(&path, p, from, from + window));
                prop_assert_eq!(path.heading(from), path.pose_at(from).heading);
                prop_assert_eq!(path.unit(on.heading), on.heading.unit());
            }
        }
    }
}
