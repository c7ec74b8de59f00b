//! The bed for the water: height and slope under a place, without trigonometry in each question.
//!
//! *Source*: the terrain's own definition.
//!
//! *Parameters*: none.
//!
//! *Deviations*: at least a centimetre of water everywhere, so that a dry corner does not divide by zero.

use crate::flow::number::{Number, along, still};
use nalgebra::Vector2;
use world::terrain::Terrain;

const SHALLOWEST_M: f64 = 0.01;

/// The bed under a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor<N = f64> {
    /// Height, m (negative).
    pub z: N,
    /// Slope (east, north).
    pub slope: Vector2<N>,
}

/// A terrain prepared for fast evaluation: a plane that is level beyond its two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ground {
    /// Position along the slope at the datum, as a part of its run, and its gradient, 1/m.
    part: f64,
    gradient: Vector2<f64>,
    /// Heights at both ends, m.
    z: [f64; 2],
}

impl Ground {
    pub(crate) fn new(terrain: &Terrain) -> Self {
        match *terrain {
            Terrain::Level { depth_m } => Self { part: 0.0, gradient: Vector2::zeros(), z: [-depth_m; 2] },
            Terrain::Slope { middle, shoreward, shallow_m, deep_m, run_m } => {
                let gradient = shoreward / run_m;
                Self { part: 0.5 - middle.dot(&gradient), gradient, z: [-deep_m, -shallow_m] }
            }
        }
    }

    pub(crate) fn floor<N: Number>(&self, p: Vector2<N>) -> Floor<N> {
        let s = along(self.gradient, p) + self.part;
        let rise = self.z[1] - self.z[0];
        let on_slope = s.value() > 0.0 && s.value() < 1.0;
        let on_slope = if on_slope { rise } else { 0.0 };
        let z = s.within(N::from(0.0), N::from(1.0)) * rise + self.z[0];
        Floor { z: z.least(N::from(-SHALLOWEST_M)), slope: still(self.gradient * on_slope) }
    }

    /// Steepest slope.
    pub(crate) fn steepest(&self) -> f64 {
        self.gradient.norm() * (self.z[1] - self.z[0]).abs()
    }

    /// The same bed in single precision, from another datum.
    pub(crate) fn near(&self, datum: Vector2<f64>) -> NearGround {
        NearGround {
            part: (self.part + self.gradient.dot(&datum)) as f32,
            gradient: [self.gradient.x as f32, self.gradient.y as f32],
            deep: self.z[0] as f32,
            rise: (self.z[1] - self.z[0]) as f32,
        }
    }
}

/// The bed about a datum in single precision, for many filaments at once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct NearGround {
    part: f32,
    gradient: [f32; 2],
    deep: f32,
    rise: f32,
}

impl NearGround {
    /// Height of the bed at (east, north) from the datum, m (negative).
    #[inline(always)]
    pub(crate) fn z(&self, x: f32, y: f32) -> f32 {
        let s = self.part + self.gradient[0] * x + self.gradient[1] * y;
        let s = if s > 0.0 { s } else { 0.0 };
        let s = if s < 1.0 { s } else { 1.0 };
        let z = self.deep + self.rise * s;
        if z < -(SHALLOWEST_M as f32) { z } else { -(SHALLOWEST_M as f32) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::units::Heading;

    #[test]
    fn same_bed_as_the_terrain() {
        let terrain = Terrain::Slope {
            middle: Vector2::new(10.0, -40.0),
            shoreward: Heading::from_deg(250.0).unit(),
            shallow_m: 4.0,
            deep_m: 8.0,
            run_m: 100.0,
        };
        let ground = Ground::new(&terrain);
        let datum = Vector2::new(-20.0, 30.0);
        let near = ground.near(datum);
        for (x, y) in [(0.0, 0.0), (30.0, -60.0), (-200.0, 5.0), (300.0, 0.0)] {
            let floor = ground.floor(Vector2::new(x, y));
            assert!((floor.z - terrain.bed_z(x, y)).abs() < 1e-12);
            let normal = terrain.normal(x, y);
            let slope = Vector2::new(-normal.x / normal.z, -normal.y / normal.z);
            assert!((floor.slope - slope).norm() < 1e-12);
            let z = near.z((x - datum.x) as f32, (y - datum.y) as f32);
            assert!((f64::from(z) - floor.z).abs() < 2e-6);
        }
    }
}
