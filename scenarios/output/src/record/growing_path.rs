//! The way of a machine as few points: legs that lie within a tolerance of all places passed.

use nalgebra::Vector3;

/// Most corners that a way keeps; beyond, its tolerance doubles.
const MOST: usize = 1000;
/// Most places of a leg that are looked at again.
const LONGEST: usize = 256;
/// Numbers are rounded to this share of a metre, so that they take little room in a file.
const STEPS_PER_M: f64 = 1024.0;

/// A way that grows.
#[derive(Clone, Debug)]
pub(super) struct GrowingPath {
    tolerance_m: f64,
    corners: Vec<Vector3<f64>>,
    /// Places since the last corner.
    leg: Vec<Vector3<f64>>,
    newest: Option<Vector3<f64>>,
}

impl GrowingPath {
    /// An empty way with a tolerance, m.
    pub(super) fn new(tolerance_m: f64) -> Self {
        Self { tolerance_m, corners: Vec::new(), leg: Vec::new(), newest: None }
    }

    /// The next place. One that is not a number is left out.
    pub(super) fn push(&mut self, place: Vector3<f64>) {
        let p = place.map(|v| (v * STEPS_PER_M).round() / STEPS_PER_M);
        if !p.iter().all(|v| v.is_finite()) {
            return;
        }
        self.newest = Some(p);
        let Some(corner) = self.corners.last() else {
            self.corners.push(p);
            return;
        };
        let last = self.leg.last().unwrap_or(corner);
        if (p - last).norm() < self.tolerance_m {
            return;
        }
        let strays = (self.leg.iter()).any(|q| off_m(corner, &p, q) > self.tolerance_m);
        if strays || self.leg.len() == LONGEST {
            self.corners.extend(self.leg.last());
            self.leg.clear();
        }
        self.leg.push(p);
        if self.corners.len() > MOST {
            self.coarsen();
        }
    }

    fn coarsen(&mut self) {
        let mut coarse = Self::new(2.0 * self.tolerance_m);
        self.points().iter().for_each(|p| coarse.push(*p));
        *self = coarse;
    }

    /// Its points, the newest place last.
    pub(super) fn points(&self) -> Vec<Vector3<f64>> {
        let mut all = self.corners.clone();
        all.extend(self.leg.last());
        all.extend(self.newest.filter(|p| all.last() != Some(p)));
        all
    }
}

/// Distance of a point from the line from `a` to `b`, m.
fn off_m(a: &Vector3<f64>, b: &Vector3<f64>, p: &Vector3<f64>) -> f64 {
    let along = b - a;
    let share = (p - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
    (p - a - along * share.clamp(0.0, 1.0)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::math;

    /// A zig-zag of legs of 100 m, in steps of 0.2 m.
    fn zigzag(steps: usize) -> Vec<Vector3<f64>> {
        let place = |k: usize| {
            let s = 0.2 * k as f64;
            let across = (s + 50.0).rem_euclid(200.0) - 100.0;
            Vector3::new(s, across.abs(), -5.0)
        };
        (0..steps).map(place).collect()
    }

    #[test]
    fn a_zigzag_keeps_its_corners_and_no_place_strays() {
        let (places, mut way) = (zigzag(5000), GrowingPath::new(1.0));
        places.iter().for_each(|p| way.push(*p));
        let points = way.points();
        assert!((11..40).contains(&points.len()), "{}", points.len());
        for p in &places {
            let off = points.windows(2).map(|w| off_m(&w[0], &w[1], p));
            assert!(off.fold(f64::MAX, f64::min) < 2.1, "{p}");
        }
        assert!((points.last().unwrap() - places.last().unwrap()).norm() < 1e-3);
    }

    #[test]
    fn a_way_stays_bounded_and_leaves_out_what_is_no_number() {
        let mut way = GrowingPath::new(0.01);
        for k in 0..200_000 {
            let t = 0.01 * f64::from(k);
            way.push(Vector3::new(t, 10.0 * math::sin(t), math::sin(7.0 * t)));
        }
        way.push(Vector3::repeat(f64::NAN));
        assert!(way.points().len() <= MOST + 2);
        assert!(way.points().iter().all(|p| p.iter().all(|v| v.is_finite())));
    }
}
