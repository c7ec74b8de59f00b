//! What a declaration rule looks at.

use nalgebra::Vector2;
use std::f64::consts::TAU;
use world::math;
use world::units::Heading;

/// Corners of a round zone.
const CORNERS: u32 = 24;

/// The points that a declaration rule looked at last, and the zone that its size is measured by. Empty before the rule
/// looked for the first time, and if it has too few points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Zone {
    /// The points (east, north), m.
    pub points: Vec<Vector2<f64>>,
    /// Corners of the zone (east, north), m, in order.
    pub corners: Vec<Vector2<f64>>,
}

impl Zone {
    /// The smallest box round `points` with a side along `ahead`.
    pub fn boxed(points: Vec<Vector2<f64>>, ahead: Heading) -> Self {
        let Some(first) = points.first() else {
            return Self::default();
        };
        let (along, left) = (ahead.unit(), ahead.turned(-TAU / 4.0).unit());
        let own = |p: &Vector2<f64>| Vector2::new(p.dot(&along), p.dot(&left));
        let first = own(first);
        let (low, high) = (points.iter().map(own)).fold((first, first), |(l, h), p| (l.inf(&p), h.sup(&p)));
        let corner = |x: f64, y: f64| along * x + left * y;
        Self {
            points,
            corners: vec![corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y), corner(low.x, high.y)],
        }
    }

    /// A circle of `radius_m` round the mean of `points`.
    pub fn round(points: Vec<Vector2<f64>>, radius_m: f64) -> Self {
        if points.is_empty() {
            return Self::default();
        }
        let mean = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
        let corner = |k: u32| {
            let (sin, cos) = math::sin_cos(f64::from(k) * TAU / f64::from(CORNERS));
            mean + Vector2::new(cos, sin) * radius_m
        };
        Self { points, corners: (0..CORNERS).map(corner).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(of: &[[f64; 2]]) -> Vec<Vector2<f64>> {
        of.iter().map(|p| Vector2::from(*p)).collect()
    }

    #[test]
    fn a_box_has_its_sides_along_the_heading() {
        let three = points(&[[0.0, 0.0], [2.0, 2.0], [1.0, 3.0]]);
        let north = Zone::boxed(three.clone(), Heading::from_deg(0.0));
        let want = points(&[[2.0, 0.0], [2.0, 3.0], [0.0, 3.0], [0.0, 0.0]]);
        for (got, want) in north.corners.iter().zip(&want) {
            assert!((got - want).norm() < 1e-12, "{:?}", north.corners);
        }
        // Along the diagonal: from 0 to 2 √2, and from 0 to √2 to the left.
        let slanted = Zone::boxed(three, Heading::from_deg(45.0));
        let want = points(&[[0.0, 0.0], [2.0, 2.0], [1.0, 3.0], [-1.0, 1.0]]);
        for (got, want) in slanted.corners.iter().zip(&want) {
            assert!((got - want).norm() < 1e-12, "{:?}", slanted.corners);
        }
    }

    #[test]
    fn a_circle_lies_round_the_mean_and_nothing_has_no_zone() {
        let zone = Zone::round(points(&[[0.0, 0.0], [4.0, 2.0]]), 6.0);
        assert_eq!(zone.corners.len(), 24);
        let middle = Vector2::new(2.0, 1.0);
        assert!((zone.corners.iter()).all(|c| ((c - middle).norm() - 6.0).abs() < 1e-12));
        assert_eq!(Zone::round(Vec::new(), 6.0), Zone::default());
        assert_eq!(Zone::boxed(Vec::new(), Heading::from_deg(0.0)), Zone::default());
    }
}
