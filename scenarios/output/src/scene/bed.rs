//! The bed as a grid of points, and its colours by depth.

use crate::ros::Marker;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::terrain::Terrain;

/// Points along each side.
const POINTS: usize = 64;
/// How far the grid reaches beyond the area, as a share of each side of it.
const MARGIN: f64 = 0.06;
/// Colours from the shallowest to the deepest place, as red, green, blue.
const RAMP: [[f32; 3]; 4] = [[0.86, 0.79, 0.60], [0.62, 0.66, 0.55], [0.33, 0.47, 0.50], [0.15, 0.27, 0.38]];
/// Of every so many points one stands in the surface for ROS, whose triangles do not share corners.
const STRIDE: usize = 3;
/// Differences of depth below this one are no reason for a colour of their own, m.
const LEVEL_M: f64 = 0.02;

/// The bed over the area and a little more.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bed {
    /// Rows, from the back of the area's axis to its front.
    pub rows: usize,
    /// Points of a row, from left to right of the axis.
    pub columns: usize,
    /// The points (ENU, m), row by row.
    pub points: Vec<Vector3<f64>>,
}

impl Bed {
    /// That of an area.
    pub fn from_terrain(area: &Area, terrain: &Terrain) -> Self {
        let share = |k: usize| (1.0 + 2.0 * MARGIN) * (k as f64 / (POINTS - 1) as f64 - 0.5);
        let at = |i: usize, j: usize| {
            let local = Vector2::new(share(i) * area.length_m, share(j) * area.width_m);
            let p = area.world(local);
            Vector3::new(p.x, p.y, terrain.bed_z(p.x, p.y))
        };
        let points = (0..POINTS).flat_map(|i| (0..POINTS).map(move |j| at(i, j)));
        Self { rows: POINTS, columns: POINTS, points: points.collect() }
    }

    /// Numbers of the corners of its triangles, anticlockwise seen from above.
    pub fn triangles(&self) -> Vec<[usize; 3]> {
        let fields = (1..self.rows).flat_map(|i| (1..self.columns).map(move |j| (i - 1, j - 1)));
        fields
            .flat_map(|(i, j)| {
                let a = i * self.columns + j;
                let (b, d) = (a + self.columns, a + 1);
                let c = b + 1;
                // Along the area, then to the right of it: clockwise from above, so the other way round.
                [[a, c, b], [a, d, c]]
            })
            .collect()
    }

    /// Colour of each point: red, green, blue, opacity, 0 to 1.
    pub fn colours(&self) -> Vec<[f32; 4]> {
        let heights = || self.points.iter().map(|p| p.z);
        let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
        let share = |z: f64| match high - low {
            range if range > LEVEL_M => (high - z) / range,
            _ => 0.0,
        };
        heights().map(|z| colour(share(z) as f32)).collect()
    }

    /// Every third point of every third row.
    fn coarse(&self) -> Self {
        let rows = (0..self.rows).step_by(STRIDE);
        let columns = || (0..self.columns).step_by(STRIDE);
        Self {
            rows: rows.len(),
            columns: columns().len(),
            points: rows.flat_map(|i| columns().map(move |j| self.points[i * self.columns + j])).collect(),
        }
    }

    /// As a surface to look at.
    pub fn marker(&self) -> Marker {
        let coarse = self.coarse();
        let (colours, triangles) = (coarse.colours(), coarse.triangles());
        Marker {
            name: "bed".to_owned(),
            colour: colours.first().copied().unwrap_or_default(),
            colours: triangles.as_flattened().iter().map(|k| colours[*k]).collect(),
            triangles: triangles.iter().map(|t| t.map(|k| self.points[k])).collect(),
        }
    }
}

/// The colour at a share of the ramp, 0 to 1.
fn colour(share: f32) -> [f32; 4] {
    let at = share.clamp(0.0, 1.0) * (RAMP.len() - 1) as f32;
    let k = (at as usize).min(RAMP.len() - 2);
    let (from, to, part) = (RAMP[k], RAMP[k + 1], at - k as f32);
    let [r, g, b] = [0, 1, 2].map(|c| from[c] + part * (to[c] - from[c]));
    [r, g, b, 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn the_bed_covers_more_than_the_area_and_looks_up() {
        let (area, terrain) = (sample::area(), sample::terrain());
        let bed = Bed::from_terrain(&area, &terrain);
        assert_eq!(bed.points.len(), bed.rows * bed.columns);
        let mut covered_m2 = 0.0;
        for [a, b, c] in bed.triangles().iter().map(|t| t.map(|k| bed.points[k])) {
            let normal = (b - a).cross(&(c - a));
            assert!(normal.z > 0.0);
            covered_m2 += normal.z / 2.0;
            assert_eq!(a.z, terrain.bed_z(a.x, a.y));
        }
        let grown = (1.0 + 2.0 * MARGIN) * (1.0 + 2.0 * MARGIN);
        assert!((covered_m2 / (grown * area.length_m * area.width_m) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn deeper_is_darker_and_a_level_bed_has_one_colour() {
        let bed = Bed::from_terrain(&sample::area(), &sample::terrain());
        let mut of_depth: Vec<(f64, f32)> =
            (bed.points.iter().zip(bed.colours())).map(|(p, [r, g, b, _])| (-p.z, r + g + b)).collect();
        of_depth.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(of_depth.windows(2).all(|w| w[1].1 <= w[0].1 + 1e-6));
        // The surface for ROS reaches as far: a multiple of the stride lies between the first and the last point.
        let ends = |b: &Bed| [b.points[0], b.points[b.points.len() - 1]];
        assert_eq!(ends(&bed.coarse()), ends(&bed));
        let level = Bed::from_terrain(&sample::area(), &Terrain::Level { depth_m: 5.0 });
        let colours = level.colours();
        assert!(colours.iter().all(|c| *c == colours[0]));
    }
}
