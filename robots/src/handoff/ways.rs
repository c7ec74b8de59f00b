//! Ways that a vehicle could go next, and what its map expects on each of them.

use nalgebra::Vector2;
use std::sync::Arc;
use world::math;
use world::units::Heading;

/// Ways from one place: each begins with the vehicle's heading and has the same length. They follow from these numbers
/// alone, so that who asks about them and who answers mean the same ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaysAhead {
    /// Number of the question; each new one has the next number.
    pub number: u32,
    /// Where they begin (east, north), m.
    pub from: Vector2<f64>,
    /// Height of all of them (up from the still surface), m.
    pub z_m: f64,
    /// Heading at the beginning.
    pub heading: Heading,
    /// Radius of the tightest turn, m; 0 for a vehicle that turns on the spot: its ways are straight, all round.
    pub radius_m: f64,
    /// Length of each way, m.
    pub length_m: f64,
}

/// How many ways there are.
pub const WAYS: usize = 7;
/// Points of a way at which the map is asked.
const POINTS: usize = 3;

impl WaysAhead {
    /// The end of each way (east, north), m, and the heading there.
    pub fn ends(&self) -> [(Vector2<f64>, Heading); WAYS] {
        self.after(1.0)
    }

    /// Points of way `k` at which dye could be met, m.
    pub fn points(&self, k: usize) -> [Vector2<f64>; POINTS] {
        [1, 2, 3].map(|part| self.place(k, f64::from(part) / POINTS as f64))
    }

    /// The place on way `k` (east, north) after a share of its length, m.
    pub fn place(&self, k: usize, share: f64) -> Vector2<f64> {
        self.after(share)[k].0
    }

    /// Places and headings after a share of each way: straight on; turning with the tightest radius and three times it,
    /// to both sides; and round with the tightest radius until the vehicle heads back, then straight.
    fn after(&self, share: f64) -> [(Vector2<f64>, Heading); WAYS] {
        let length_m = share * self.length_m;
        let curvatures = [0.0, 1.0, -1.0, 1.0 / 3.0, -1.0 / 3.0, 1.0, -1.0];
        let mut all = [(self.from, self.heading); WAYS];
        for (k, (way, curvature)) in all.iter_mut().zip(curvatures).enumerate() {
            if self.radius_m <= 0.0 {
                let heading = self.heading.turned(std::f64::consts::TAU * k as f64 / WAYS as f64);
                *way = (self.from + heading.unit() * length_m, heading);
                continue;
            }
            // A tight turn of a way that goes on ends after a right angle; one that goes back, after two.
            let most = match k {
                0 => 0.0,
                1 | 2 => std::f64::consts::FRAC_PI_2,
                _ => std::f64::consts::PI,
            };
            let turn = (length_m * f64::abs(curvature) / self.radius_m).min(most);
            *way = if curvature == 0.0 {
                (self.from + self.heading.unit() * length_m, self.heading)
            } else {
                let radius_m = self.radius_m / curvature.abs();
                let chord = 2.0 * radius_m * math::sin(turn / 2.0);
                let side = curvature.signum();
                let heading = self.heading.turned(side * turn);
                let middle = self.heading.turned(side * turn / 2.0);
                let rest = (length_m - radius_m * turn).max(0.0);
                (self.from + middle.unit() * chord + heading.unit() * rest, heading)
            };
        }
        all
    }
}

/// What a map expects on ways ahead.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlook {
    /// The ways.
    pub ways: WaysAhead,
    /// For each way: the chance of a detection on it if the source is in this cell, one number a cell.
    pub chances: Vec<Arc<Vec<f64>>>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ways(radius_m: f64, length_m: f64) -> WaysAhead {
        let from = Vector2::new(10.0, 20.0);
        WaysAhead { number: 1, from, z_m: -5.0, heading: Heading::from_deg(0.0), radius_m, length_m }
    }

    #[test]
    fn ends_by_hand() {
        // Straight on; a quarter circle to the right of 10 m and what is left of 30 m; the wider one.
        let ends = ways(10.0, 30.0).ends();
        assert!((ends[0].0 - Vector2::new(10.0, 50.0)).norm() < 1e-9);
        let rest = 30.0 - 5.0 * std::f64::consts::PI;
        assert!((ends[1].0 - Vector2::new(20.0 + rest, 30.0)).norm() < 1e-9);
        assert!((ends[1].1.deg() - 90.0).abs() < 1e-9 && (ends[2].1.deg() - 270.0).abs() < 1e-9);
        let (s, c) = math::sin_cos(1.0);
        assert!((ends[3].0 - Vector2::new(10.0 + 30.0 * (1.0 - c), 20.0 + 30.0 * s)).norm() < 1e-9);
        // Half a circle ends beside the start, heading back.
        let back = ways(10.0, 10.0 * std::f64::consts::PI).ends()[5];
        assert!((back.0 - Vector2::new(30.0, 20.0)).norm() < 1e-9 && (back.1.deg() - 180.0).abs() < 1e-9);
    }

    #[test]
    fn no_step_of_a_way_is_longer_than_its_share_and_mirrored_ways_mirror() {
        for (radius_m, length_m) in [(12.0, 24.0), (12.0, 60.0), (0.0, 20.0), (40.0, 25.0)] {
            let w = ways(radius_m, length_m);
            for k in 0..WAYS {
                let mut before = w.from;
                for p in w.points(k) {
                    assert!((p - before).norm() <= length_m / POINTS as f64 + 1e-9);
                    before = p;
                }
                assert!((before - w.ends()[k].0).norm() < 1e-12);
            }
            if radius_m > 0.0 {
                for (right, left) in [(1, 2), (3, 4), (5, 6)] {
                    let (r, l) = (w.ends()[right].0 - w.from, w.ends()[left].0 - w.from);
                    assert!((r.x + l.x).abs() < 1e-9 && (r.y - l.y).abs() < 1e-9);
                }
            }
        }
    }
}
