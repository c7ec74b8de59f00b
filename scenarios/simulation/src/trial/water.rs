//! The flow of the water on a coarse grid, for those who look.

use crate::frame::WaterFrame;
use crate::ocean::Ocean;
use nalgebra::{Vector2, Vector3};
use world::fields::Flow;

/// About so many places are asked, as nearly as far apart along the area as across it.
const PLACES: f64 = 120.0;
/// Most places along a side.
const MOST: f64 = 40.0;
/// Heights above the bed, as shares of the depth there: near the bed, in the middle, near the surface.
const HEIGHTS: [f64; 3] = [0.12, 0.5, 0.92];
/// Places are rounded to such parts of a metre, velocities to such parts of 1 m/s: rounded numbers take half the room
/// in a recording.
const PLACES_A_M: f64 = 1024.0;
const STEPS_A_M_S: f64 = 8192.0;

fn rounded(number: f64, parts: f64) -> f64 {
    (number * parts).round() / parts
}

/// The flow at a time of the mission, s. Places inside obstacles are omitted.
pub(super) fn pictured(ocean: &Ocean, t_s: f64) -> WaterFrame {
    let area = &ocean.area;
    let along = (PLACES * area.length_m / area.width_m).sqrt();
    let count = |n: f64| n.round().clamp(2.0, MOST) as u32;
    let (rows, columns) = (count(along), count(PLACES / along));
    let mut points = Vec::new();
    for share in HEIGHTS {
        for i in 0..rows {
            for j in 0..columns {
                let middle = |k: u32, n: u32| (f64::from(k) + 0.5) / f64::from(n) - 0.5;
                let local = Vector2::new(middle(i, rows) * area.length_m, middle(j, columns) * area.width_m);
                let p = area.world(local);
                let z = ocean.terrain.bed_z(p.x, p.y) * (1.0 - share);
                let p_W = Vector3::new(p.x, p.y, z);
                if ocean.obstacles.containing(&p_W).is_none() {
                    let v = ocean.velocity(&p_W, t_s);
                    let [x, y, z] = [p.x, p.y, z].map(|m| rounded(m, PLACES_A_M));
                    let [vx, vy, vz] = [v.x, v.y, v.z].map(|m_s| rounded(m_s, STEPS_A_M_S));
                    points.push([x, y, z, vx, vy, vz]);
                }
            }
        }
    }
    WaterFrame { t_s, points, centre: area.centre }
}
