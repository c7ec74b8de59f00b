//! The bed: its height anywhere, and as a surface that bodies can hit.

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
    /// A plane rising towards `shoreward`, levelling off at the two depths.
    Slope {
        /// Point (east, north) at which the depth is the mean of the two.
        middle: Vector2<f64>,
        /// Direction in which the water gets shallower.
        shoreward: Heading,
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
    #[must_use]
    pub fn sloping_over(area: &Area, shoreward: Heading, shallow_m: f64, deep_m: f64) -> Self {
        let u = shoreward.unit();
        let reach = area
            .corners()
            .iter()
            .map(|c| (c - area.centre).dot(&u))
            .fold(0.0, f64::max);
        Terrain::Slope {
            middle: area.centre,
            shoreward,
            shallow_m,
            deep_m,
            run_m: 2.0 * reach,
        }
    }

    /// Height of the bed (negative: below the still surface), m.
    #[must_use]
    pub fn bed_z(&self, x: f64, y: f64) -> f64 {
        match *self {
            Terrain::Level { depth_m } => -depth_m,
            Terrain::Slope {
                middle,
                shoreward,
                shallow_m,
                deep_m,
                run_m,
            } => {
                let s = (Vector2::new(x, y) - middle).dot(&shoreward.unit()) / run_m + 0.5;
                -(deep_m + (shallow_m - deep_m) * s.clamp(0.0, 1.0))
            }
        }
    }

    /// Upward unit normal of the bed.
    #[must_use]
    pub fn normal(&self, x: f64, y: f64) -> Vector3<f64> {
        const H: f64 = 0.5;
        let dx = (self.bed_z(x + H, y) - self.bed_z(x - H, y)) / (2.0 * H);
        let dy = (self.bed_z(x, y + H) - self.bed_z(x, y - H)) / (2.0 * H);
        Vector3::new(-dx, -dy, 1.0).normalize()
    }

    /// Least depth anywhere, m.
    #[must_use]
    pub fn shallowest_m(&self) -> f64 {
        match *self {
            Terrain::Level { depth_m } => depth_m,
            Terrain::Slope { shallow_m, .. } => shallow_m,
        }
    }

    /// Greatest depth anywhere, m.
    #[must_use]
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
        let area = Area {
            centre: Vector2::new(5.0, -3.0),
            length_m: 1094.0,
            width_m: 367.0,
            axis: Heading::from_deg(340.0),
        };
        let t = Terrain::sloping_over(&area, Heading::from_deg(250.0), 4.0, 8.0);
        let shore = area.world(Vector2::new(0.0, -183.5));
        let sea = area.world(Vector2::new(0.0, 183.5));
        assert!((t.bed_z(shore.x, shore.y) + 4.0).abs() < 1e-9);
        assert!((t.bed_z(sea.x, sea.y) + 8.0).abs() < 1e-9);
        let mid = t.normal(5.0, -3.0);
        assert!(mid.z > 0.999 && mid.norm() - 1.0 < 1e-12);
    }
}
