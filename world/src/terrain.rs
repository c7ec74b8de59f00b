//! The bed: its height at any place, and its surface for bodies.

use crate::area::Area;
use crate::units::Heading;
use bevy_ecs::prelude::Resource;
use nalgebra::{Vector2, Vector3};

/// The bed below the water.
#[derive(Resource, Clone, Debug, PartialEq)]
pub enum Terrain {
    /// Level bed at a depth, m.
    Level {
        /// Water depth, m.
        depth_m: f64,
    },
    /// A plane that rises towards `shoreward` and levels off at the two depths.
    Slope {
        /// Point (east, north) at which the depth is the mean of the two.
        middle: Vector2<f64>,
        /// Unit vector (east, north) of the direction in which the water gets shallower.
        shoreward: Vector2<f64>,
        /// Least depth, m.
        shallow_m: f64,
        /// Greatest depth, m.
        deep_m: f64,
        /// Horizontal distance between the two depths, m.
        run_m: f64,
    },
}

impl Terrain {
    /// A slope across the width of the area, shallow side `shoreward`.
    pub fn sloping_over(area: &Area, shoreward: Heading, shallow_m: f64, deep_m: f64) -> Self {
        let u = shoreward.unit();
        let reach = area.corners().iter().map(|c| (c - area.centre).dot(&u)).fold(0.0, f64::max);
        Terrain::Slope { middle: area.centre, shoreward: u, shallow_m, deep_m, run_m: 2.0 * reach }
    }

    /// Height of the bed (negative: below the still surface), m.
    pub fn bed_z(&self, x: f64, y: f64) -> f64 {
        match *self {
            Terrain::Level { depth_m } => -depth_m,
            Terrain::Slope { middle, shoreward, shallow_m, deep_m, run_m } => {
                let s = (Vector2::new(x, y) - middle).dot(&shoreward) / run_m + 0.5;
                -(deep_m + (shallow_m - deep_m) * s.clamp(0.0, 1.0))
            }
        }
    }

    /// Upward unit normal of the bed.
    pub fn normal(&self, x: f64, y: f64) -> Vector3<f64> {
        const H: f64 = 0.5;
        let dx = (self.bed_z(x + H, y) - self.bed_z(x - H, y)) / (2.0 * H);
        let dy = (self.bed_z(x, y + H) - self.bed_z(x, y - H)) / (2.0 * H);
        Vector3::new(-dx, -dy, 1.0).normalize()
    }

    /// Distance along a ray from `from` (ENU, m) in the unit direction `dir` to the bed within `max_m`, m; zero if it
    /// starts below the bed.
    pub fn ray(&self, from: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> Option<f64> {
        let above = |way: f64| {
            let p = from + dir * way;
            p.z - self.bed_z(p.x, p.y)
        };
        // The bed is flat between the lines where the slope begins and ends, so the height above it is linear along the
        // ray.
        let mut bends = [max_m; 3];
        if let Terrain::Slope { middle, shoreward, run_m, .. } = self {
            let (at, pace) = ((from.xy() - middle).dot(shoreward), dir.xy().dot(shoreward));
            for (bend, edge) in bends.iter_mut().zip([-0.5 * run_m, 0.5 * run_m]) {
                let way = (edge - at) / pace;
                if way > 0.0 && way < max_m {
                    *bend = way;
                }
            }
            if bends[0] > bends[1] {
                bends.swap(0, 1);
            }
        }
        let (mut free, mut height) = (0.0, above(0.0));
        if height <= 0.0 {
            return Some(0.0);
        }
        for end in bends {
            let there = above(end);
            if there <= 0.0 {
                return Some(free + (end - free) * height / (height - there));
            }
            (free, height) = (end, there);
        }
        None
    }

    /// Least depth anywhere, m.
    pub fn shallowest_m(&self) -> f64 {
        match *self {
            Terrain::Level { depth_m } => depth_m,
            Terrain::Slope { shallow_m, .. } => shallow_m,
        }
    }

    /// Greatest depth anywhere, m.
    pub fn deepest_m(&self) -> f64 {
        match *self {
            Terrain::Level { depth_m } => depth_m,
            Terrain::Slope { deep_m, .. } => deep_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slope_reaches_both_depths_at_the_edges() {
        let area =
            Area { centre: Vector2::new(5.0, -3.0), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) };
        let t = Terrain::sloping_over(&area, Heading::from_deg(250.0), 4.0, 8.0);
        let shore = area.world(Vector2::new(0.0, -183.5));
        let sea = area.world(Vector2::new(0.0, 183.5));
        assert!((t.bed_z(shore.x, shore.y) + 4.0).abs() < 1e-9);
        assert!((t.bed_z(sea.x, sea.y) + 8.0).abs() < 1e-9);
        let mid = t.normal(5.0, -3.0);
        assert!(mid.z > 0.999 && mid.norm() - 1.0 < 1e-12);
    }

    #[test]
    fn rays_end_on_level_slope_and_the_flats_beyond() {
        let t = Terrain::Slope {
            middle: Vector2::zeros(),
            shoreward: Heading::from_deg(90.0).unit(),
            shallow_m: 4.0,
            deep_m: 8.0,
            run_m: 100.0,
        };
        let level = Terrain::Level { depth_m: 8.0 };
        let mut met = [0; 4];
        for k in 0..2000 {
            let turn = f64::from(k) * 0.37;
            let (s, c) = crate::math::sin_cos(turn);
            let from = Vector3::new(-80.0 + f64::from(k % 160), 3.0, -3.5 - 0.4 * s * s);
            let dir = Vector3::new(c, s, -0.02 - 0.3 * f64::from(k % 7)).normalize();
            for t in [&t, &level] {
                let way = t.ray(&from, &dir, 60.0);
                let end = from + dir * way.unwrap_or(60.0);
                let over = end.z - t.bed_z(end.x, end.y);
                if way.is_some() {
                    assert!(over.abs() < 1e-9, "{over}");
                    met[usize::from(end.x > -50.0) + usize::from(end.x > 50.0)] += 1;
                } else {
                    assert!(over > 0.0);
                    met[3] += 1;
                }
                // The ray passed nothing solid on its way.
                for part in 1..20 {
                    let p = from + dir * (way.unwrap_or(60.0) * f64::from(part) / 20.0);
                    assert!(p.z - t.bed_z(p.x, p.y) > -1e-9);
                }
            }
        }
        assert!(met.iter().all(|n| *n > 50), "{met:?}");
        assert_eq!(level.ray(&Vector3::new(0.0, 0.0, -9.0), &Vector3::x(), 5.0), Some(0.0));
    }
}
