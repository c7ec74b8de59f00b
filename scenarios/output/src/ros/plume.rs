//! A plume and the flow of the water as clouds of points, in a frame at the centre of the area.

use super::{nanoseconds, point_cloud};
use rheotaxis::frame::{PlumeFrame, WaterFrame};
use std::f64::consts::TAU;

/// Filaments as a `PointCloud2`. `mass` is that of all filaments for which one stands (kg); `concentration` is that at
/// the centre of one filament, kg/m³: `mass` / `stands_for` / ((2π)^(3/2) `size`³).
pub fn plume_cloud(plume: &PlumeFrame, frame: &str) -> Vec<u8> {
    let shape = (TAU * TAU.sqrt()) as f32;
    let local = plume.local();
    let rows: Vec<[f32; 7]> = local
        .iter()
        .map(|&[x, y, z, size, mass, n]| {
            let volume = shape * size * size * size;
            let c = if volume > 0.0 { mass / n / volume } else { 0.0 };
            [x, y, z, size, mass, c, n]
        })
        .collect();
    let names = ["x", "y", "z", "size", "mass", "concentration", "stands_for"];
    point_cloud(nanoseconds(plume.t_s), frame, names, &rows)
}

/// The flow as a `PointCloud2`: a place (m) and the velocity there (m/s), both in `frame`.
pub fn water_cloud(water: &WaterFrame, frame: &str) -> Vec<u8> {
    let names = ["x", "y", "z", "vx", "vy", "vz"];
    point_cloud(nanoseconds(water.t_s), frame, names, &water.local())
}
