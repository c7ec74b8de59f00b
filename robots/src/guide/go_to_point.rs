//! Heads for a point at constant speed.
//!
//! *Source*: Pang 2009, section 4.1, eq. 4-6.
//!
//! *Parameters*: arrival radius R, `arrive_m` (or the goal's own radius), m, 10.
//!
//! *Deviations*: eq. 4 is the arctangent of (current - target) without quadrant: here it is the four-quadrant
//! direction of (target - current). A vehicle whose turning circle is wider than R could circle a point for ever:
//! after a whole turn around it, the vehicle keeps its course until it is twice R (or two turning radii) away.

use nalgebra::Vector2;
use std::f64::consts::TAU;
use world::units::Heading;

/// State of going to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct GoToPoint {
    point: Vector2<f64>,
    radius_m: f64,
    clear_m: f64,
    bearing: Option<Heading>,
    wound_rad: f64,
    away: Option<Heading>,
    arrived: bool,
}

impl GoToPoint {
    pub(super) fn new(point: Vector2<f64>, radius_m: f64, turn_radius_m: f64) -> Self {
        Self {
            point,
            radius_m,
            clear_m: 2.0 * radius_m.max(turn_radius_m),
            bearing: None,
            wound_rad: 0.0,
            away: None,
            arrived: false,
        }
    }

    /// Course to take, and whether the point has been reached; `moving` gives the course over ground.
    pub(super) fn step(&mut self, position: Vector2<f64>, moving: impl FnOnce() -> Heading) -> (Heading, bool) {
        let to = self.point - position;
        let distance_m = to.norm();
        self.arrived |= distance_m < self.radius_m;
        let bearing = Heading::from_vector(to);
        if let Some(last) = self.bearing.replace(bearing) {
            self.wound_rad += last.turn_to(bearing);
        }
        if self.arrived {
            self.wound_rad = 0.0;
        }
        if self.wound_rad.abs() > TAU {
            self.wound_rad = 0.0;
            self.away = Some(moving());
        }
        match self.away {
            Some(course) if distance_m < self.clear_m => (course, self.arrived),
            _ => {
                self.away = None;
                (bearing, self.arrived)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn all_four_quadrants() {
        for (east, north, deg) in [(1.0, 1.0, 45.0), (1.0, -1.0, 135.0), (-1.0, -1.0, 225.0), (-1.0, 1.0, 315.0)] {
            let mut g = GoToPoint::new(Vector2::new(50.0 * east, 50.0 * north), 10.0, 15.0);
            let (h, arrived) = g.step(Vector2::zeros(), || Heading::from_deg(0.0));
            assert!((h.deg() - deg).abs() < 1e-9 && !arrived);
        }
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        // A vehicle with an 11.5 m turning circle, a 10 m radius: from anywhere it arrives.
        #[test]
        fn arrives_from_anywhere(east in -60.0..60.0, north in -60.0..60.0, heading in 0.0..360.0, radius in 2.0..10.0) {
            let mut g = GoToPoint::new(Vector2::zeros(), radius, 15.0);
            let mut p = Vector2::new(east, north);
            let mut h = Heading::from_deg(heading);
            let mut arrived = false;
            for _ in 0..3000 {
                let (want, done) = g.step(p, || h);
                arrived = done;
                if done { break; }
                let most = 10f64.to_radians() * 0.1;
                h = h.turned(h.turn_to(want).clamp(-most, most));
                p += h.unit() * 0.2;
            }
            prop_assert!(arrived);
        }
    }
}
