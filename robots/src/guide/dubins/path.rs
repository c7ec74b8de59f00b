//! The shortest curve-straight-curve path between two poses with a least turning radius.
//!
//! *Source*: Pang 2009, section 4.3; Dubins 1957 (American Journal of Mathematics 79).
//!
//! *Parameters*: turning radius R_m, `turn_radius_m`, m (not printed), 15.
//!
//! *Deviations*: none. As in the paper the CCC paths are left out, though one of them can be shorter for poses that
//! are near each other.

use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_2, TAU};
use world::math;
use world::units::{Heading, wrap_tau};

/// Place and direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// (east, north), m.
    pub position: Vector2<f64>,
    /// Direction of motion.
    pub heading: Heading,
}

/// A path of two arcs joined by a straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DubinsPath {
    start: Pose,
    radius_m: f64,
    /// +1 clockwise, -1 anticlockwise.
    turns: [f64; 2],
    /// Lengths of arc, straight, arc, m.
    lengths_m: [f64; 3],
    /// Poses where the straight part and the second arc begin.
    joints: [Pose; 2],
}

impl DubinsPath {
    /// The shortest of the (up to four) candidates; the two whose arcs turn the same way always exist.
    #[must_use]
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
        best.expect("a path turning the same way twice exists between any two poses; a non-finite pose was given: \
            check the estimate")
    }

    fn candidate(start: Pose, end: Pose, radius_m: f64, turns: [f64; 2]) -> Option<Self> {
        let centre = |p: Pose, turn: f64| p.position + side(p.heading, turn) * radius_m;
        let between = centre(end, turns[1]) - centre(start, turns[0]);
        let distance_m = between.norm();
        if !distance_m.is_finite() {
            return None;
        }
        let (straight_m, course) = if turns[0] == turns[1] {
            // Outer tangent; concentric circles need no straight.
            let course = if distance_m < 1e-9 {
                start.heading
            } else {
                Heading::of(between)
            };
            (distance_m, course)
        } else {
            if distance_m < 2.0 * radius_m {
                return None;
            }
            // Inner tangent: leans from the line of centres by asin(2r / d), to the side of the first turn.
            let lean = math::asin((2.0 * radius_m / distance_m).min(1.0));
            let straight = (distance_m * distance_m - 4.0 * radius_m * radius_m).max(0.0);
            (
                straight.sqrt(),
                Heading::of(between).turned(turns[0] * lean),
            )
        };
        let swept = |from: Heading, to: Heading, turn: f64| {
            let angle = wrap_tau(turn * (to.rad() - from.rad()));
            // Rounding must not turn no turn at all into a whole circle.
            if TAU - angle < 1e-9 { 0.0 } else { angle }
        };
        let arcs = [
            swept(start.heading, course, turns[0]) * radius_m,
            swept(course, end.heading, turns[1]) * radius_m,
        ];
        let leave = along_arc(start, turns[0], radius_m, arcs[0]);
        let enter = Pose {
            position: leave.position + course.unit() * straight_m,
            heading: course,
        };
        Some(Self {
            start,
            radius_m,
            turns,
            lengths_m: [arcs[0], straight_m, arcs[1]],
            joints: [leave, enter],
        })
    }

    /// Whole length, m.
    #[must_use]
    pub fn length_m(&self) -> f64 {
        self.lengths_m.iter().sum()
    }

    /// Pose after `s_m` metres, held within the path.
    #[must_use]
    pub fn at(&self, s_m: f64) -> Pose {
        let [a, b, c] = self.lengths_m;
        let s = s_m.clamp(0.0, a + b + c);
        if s <= a {
            along_arc(self.start, self.turns[0], self.radius_m, s)
        } else if s <= a + b {
            Pose {
                position: self.joints[0].position + self.joints[1].heading.unit() * (s - a),
                heading: self.joints[1].heading,
            }
        } else {
            along_arc(self.joints[1], self.turns[1], self.radius_m, s - a - b)
        }
    }

    /// Place along the path, m, between `from_m` and `to_m`, that is nearest to `p`.
    #[must_use]
    pub fn nearest(&self, p: Vector2<f64>, from_m: f64, to_m: f64) -> f64 {
        let [a, b, c] = self.lengths_m;
        let feet = [
            self.arc_foot(self.start, self.turns[0], p, a),
            a + (p - self.joints[0].position).dot(&self.joints[1].heading.unit()),
            a + b + self.arc_foot(self.joints[1], self.turns[1], p, c),
        ];
        let spans = [(0.0, a), (a, a + b), (a + b, a + b + c)];
        let mut best = (f64::INFINITY, from_m);
        for (foot, (lo, hi)) in feet.into_iter().zip(spans) {
            let (lo, hi) = (f64::max(lo, from_m), f64::min(hi, to_m));
            if lo > hi {
                continue;
            }
            // The foot on an arc is known up to a whole circle; the ends cover what clamping misses.
            for s in [foot.clamp(lo, hi), lo, hi] {
                let d = (self.at(s).position - p).norm();
                if d < best.0 - 1e-12 {
                    best = (d, s);
                }
            }
        }
        best.1
    }

    /// Length along an arc from its start to the point nearest to `p`, in [0, circumference).
    fn arc_foot(&self, start: Pose, turn: f64, p: Vector2<f64>, length_m: f64) -> f64 {
        let centre = start.position + side(start.heading, turn) * self.radius_m;
        let from = Heading::of(start.position - centre);
        let to = Heading::of(p - centre);
        let s = wrap_tau(turn * (to.rad() - from.rad())) * self.radius_m;
        // Just behind the start is behind, not a whole circle ahead.
        let behind = s - TAU * self.radius_m;
        if s > length_m && -behind < s - length_m {
            behind
        } else {
            s
        }
    }
}

/// Unit vector to the side of a turn: right for clockwise.
fn side(heading: Heading, turn: f64) -> Vector2<f64> {
    heading.turned(turn * FRAC_PI_2).unit()
}

fn along_arc(start: Pose, turn: f64, radius_m: f64, s_m: f64) -> Pose {
    let centre = start.position + side(start.heading, turn) * radius_m;
    let heading = start.heading.turned(turn * s_m / radius_m);
    Pose {
        position: centre + side(heading, turn).scale(-radius_m),
        heading,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn pose(east: f64, north: f64, deg: f64) -> Pose {
        Pose {
            position: Vector2::new(east, north),
            heading: Heading::from_deg(deg),
        }
    }

    #[test]
    fn straight_ahead_is_straight() {
        let p = DubinsPath::shortest(
            pose(0.0, 0.0, 30.0),
            {
                let u = Heading::from_deg(30.0).unit() * 100.0;
                pose(u.x, u.y, 30.0)
            },
            15.0,
        );
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
            let end = path.at(length);
            prop_assert!((end.position - b.position).norm() < 1e-6);
            prop_assert!(end.heading.turn_to(b.heading).abs() < 1e-6);
            let straight = (b.position - a.position).norm();
            prop_assert!(length >= straight - 1e-9);
            // Two whole circles and the way between two circle centres bound any CSC path.
            prop_assert!(length <= straight + 2.0 * 15.0 + 4.0 * PI * 15.0 + 1e-6);
            let n = 400;
            let step = length / f64::from(n);
            for i in 0..n {
                let (p, q) = (path.at(f64::from(i) * step), path.at(f64::from(i + 1) * step));
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
            let on = path.at(s);
            let p = on.position + side(on.heading, 1.0) * aside;
            let found = path.nearest(p, (s - 5.0).max(0.0), s + 5.0);
            prop_assert!((path.at(found).position - p).norm() <= aside.abs() + 1e-9);
        }
    }
}
