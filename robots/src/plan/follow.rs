//! Follows a path: gives the course towards a point some way ahead on it, and the height of that point.
//!
//! *Source*: pure pursuit, Coulter 1992, CMU-RI-TR-92-01; enclosure-based steering of Fossen 2011, section 10.3.
//!
//! *Parameters*: look-ahead distance, m.
//!
//! *Deviations*: progress along the path never goes back. Beyond the end, the point ahead lies on the extended last
//! leg.

use super::Path;
use nalgebra::Vector3;
use std::sync::Arc;
use world::units::Heading;

/// How far ahead progress is searched, m: a path that returns to itself must not be cut short.
const WINDOW_M: f64 = 15.0;

/// State of following a path.
#[derive(Clone, Debug)]
pub struct Follow {
    points: Arc<Vec<Vector3<f64>>>,
    upto_m: Vec<f64>,
    ahead_m: f64,
    s_m: f64,
}

/// What the vehicle must steer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steer {
    /// Course over ground.
    pub course: Heading,
    /// Height at which to move (z, m).
    pub z_m: f64,
    /// Horizontal distance off the path, m.
    pub off_m: f64,
    /// Rest of the path, m.
    pub left_m: f64,
}

impl Follow {
    /// At the start of a path.
    pub fn new(path: &Path, ahead_m: f64) -> Self {
        let mut upto_m = vec![0.0];
        for w in path.points.windows(2) {
            let last = upto_m[upto_m.len() - 1];
            upto_m.push(last + (w[1] - w[0]).xy().norm());
        }
        Self { points: Arc::new(path.points.clone()), upto_m, ahead_m, s_m: 0.0 }
    }

    /// The path.
    pub fn points(&self) -> &Arc<Vec<Vector3<f64>>> {
        &self.points
    }

    /// The part of the path still ahead.
    pub fn rest(&self) -> Vec<Vector3<f64>> {
        let mut rest = vec![self.point_at(self.s_m)];
        let next = self.upto_m.partition_point(|s| *s <= self.s_m);
        rest.extend(&self.points[next..]);
        rest
    }

    /// What to steer at a place (ENU, m).
    pub fn step(&mut self, p_W: &Vector3<f64>) -> Steer {
        let length = self.upto_m[self.upto_m.len() - 1];
        let to = self.s_m + WINDOW_M;
        let mut best = (f64::INFINITY, self.s_m);
        for k in 0..self.points.len() - 1 {
            let (lo, hi) = (self.upto_m[k].max(self.s_m), self.upto_m[k + 1].min(to));
            if lo > hi || self.upto_m[k + 1] - self.upto_m[k] < 1e-9 {
                continue;
            }
            let leg = (self.points[k + 1] - self.points[k]).xy();
            let foot = self.upto_m[k] + (p_W - self.points[k]).xy().dot(&leg) / leg.norm();
            let s = foot.clamp(lo, hi);
            let d = (self.point_at(s) - p_W).xy().norm();
            if d < best.0 {
                best = (d, s);
            }
        }
        self.s_m = best.1;
        let ahead = self.point_at(self.s_m + self.ahead_m);
        let to = (ahead - p_W).xy();
        let beyond = self.points.len() > 1 && self.s_m >= length - 1e-9;
        let course = if to.norm() > 1e-6 { Heading::from_vector(to) } else { self.last_course() };
        Steer {
            course,
            z_m: ahead.z,
            off_m: if beyond { 0.0 } else { (self.point_at(self.s_m) - p_W).xy().norm() },
            left_m: length - self.s_m,
        }
    }

    fn last_course(&self) -> Heading {
        let n = self.points.len();
        let leg = if n > 1 { (self.points[n - 1] - self.points[n - 2]).xy() } else { nalgebra::Vector2::y() };
        Heading::from_vector(leg)
    }

    /// The point after `s_m` metres (seen from above); beyond the end, on the extended last leg.
    fn point_at(&self, s_m: f64) -> Vector3<f64> {
        let n = self.points.len();
        let length = self.upto_m[n - 1];
        if s_m >= length {
            let on = self.last_course().unit() * (s_m - length);
            return self.points[n - 1] + Vector3::new(on.x, on.y, 0.0);
        }
        let k = self.upto_m.partition_point(|s| *s <= s_m).clamp(1, n - 1);
        let part = (s_m - self.upto_m[k - 1]) / (self.upto_m[k] - self.upto_m[k - 1]);
        self.points[k - 1] + (self.points[k] - self.points[k - 1]) * part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::fixed;
    use crate::plan::testing::{from, room};
    use crate::plan::{AStar, AStarParams, Planner};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(fixed(128))]

        /// A vehicle of 2 m/s and 10 °/s stays near a path smoothed for it, from any place in any direction.
        #[test]
        fn a_vehicle_with_its_turning_circle_stays_on_the_path(
            x in 30.0..170.0, y in 30.0..170.0, gx in 30.0..170.0, gy in 30.0..170.0, deg in 0.0..360.0,
        ) {
            let r = room([200, 200, 1], [1.0; 3], vec![]);
            let start = from(x, y, deg);
            let goal = Vector3::new(gx, gy, -4.0);
            let path = AStar::new(&AStarParams::default()).unwrap().plan(&r, &start, &goal).unwrap();
            prop_assume!(path.tightest_m > 0.0);
            let mut follow = Follow::new(&path, 6.0);
            let (mut p, mut h) = (start.p_W, start.heading);
            let mut worst = 0.0_f64;
            let mut left = f64::INFINITY;
            for _ in 0..5000 {
                let s = follow.step(&p);
                worst = worst.max(s.off_m);
                left = s.left_m;
                if left < 0.5 { break; }
                let most = 10f64.to_radians() * 0.1;
                h = h.turned(h.turn_to(s.course).clamp(-most, most));
                let d = h.unit() * 0.2;
                p += Vector3::new(d.x, d.y, 0.0);
            }
            prop_assert!(left < 0.5);
            prop_assert!(worst < 2.5, "{worst} m off");
        }
    }

    #[test]
    fn height_follows_the_path() {
        let path = Path {
            points: vec![Vector3::new(0.0, 0.0, -2.0), Vector3::new(0.0, 40.0, -10.0)],
            reach: crate::plan::Reach::Goal,
            leaves_solid: false,
            tightest_m: f64::INFINITY,
        };
        let mut f = Follow::new(&path, 6.0);
        let s = f.step(&Vector3::new(1.0, 14.0, -3.0));
        assert!((s.z_m + 6.0).abs() < 1e-9 && (s.off_m - 1.0).abs() < 1e-9);
        assert_eq!(f.rest().len(), 2);
        let s = f.step(&Vector3::new(0.0, 25.0, -3.0));
        assert!((s.left_m - 15.0).abs() < 1e-9);
    }
}
