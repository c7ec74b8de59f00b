//! The layers at one place and time, asked at a height.
//!
//! *Source*: as `layered`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none of its own.

use super::{LayeredColumn, Profile, Sheet};
use crate::flow::ground::Floor;
use nalgebra::Vector2;
use world::math;

impl LayeredColumn<'_> {
    /// The interfaces, top first.
    #[must_use]
    pub fn faces(&self) -> &[Sheet] {
        &self.faces[..self.of.faces.len()]
    }

    /// Height of the lowest interface across which the density changes, m. It limits the turbulence of the bed from
    /// above.
    #[must_use]
    pub fn lid(&self) -> Option<f64> {
        let rho = &self.of.density;
        let lowest = (0..self.of.faces.len())
            .rev()
            .find(|&i| rho[i] < rho[i + 1]);
        lowest.map(|i| self.faces[i].z)
    }

    /// The share of the layer above an interface in the water at a height.
    fn share(&self, face: usize, z: f64) -> f64 {
        // ½(1 + tanh(2x)) = 1/(1 + e^(−4x)), one exponential; its slope is 1/thickness in the middle.
        let x = (z - self.faces[face].z) / self.of.faces[face].thickness;
        1.0 / (1.0 + math::exp(-4.0 * x))
    }

    /// Horizontal velocity at a height, m/s: that of [`Self::profile`], without the rest.
    #[must_use]
    pub fn velocity(&self, z: f64) -> Vector2<f64> {
        let n = self.of.u.len();
        (0..n - 1).fold(self.u[n - 1], |u, i| {
            u + (self.u[i] - self.u[i + 1]) * self.share(i, z)
        })
    }

    /// Velocity, density and gradients at a height, m.
    #[must_use]
    pub fn profile(&self, z: f64) -> Profile {
        let n = self.of.u.len();
        let mut p = Profile {
            u: self.u[n - 1],
            du_dz: Vector2::zeros(),
            density: self.of.density[n - 1],
            drho_dz: 0.0,
        };
        for (i, face) in self.of.faces.iter().enumerate() {
            let share = self.share(i, z);
            let slope = 4.0 * share * (1.0 - share) / face.thickness;
            let du = self.u[i] - self.u[i + 1];
            let drho = self.of.density[i] - self.of.density[i + 1];
            p.u += du * share;
            p.du_dz += du * slope;
            p.density += drho * share;
            p.drho_dz += drho * slope;
        }
        p
    }

    /// The layer-following surface through a height between floor and surface: linear between bed, interfaces and
    /// surface.
    #[must_use]
    pub fn sheet(&self, z: f64, floor: &Floor) -> Sheet {
        let mut upper = Sheet::default();
        for lower in self.faces() {
            if z >= lower.z {
                return between(lower, &upper, z);
            }
            upper = *lower;
        }
        let bed = Sheet {
            z: floor.z,
            slope: floor.slope,
            rate: 0.0,
        };
        between(&bed, &upper, z)
    }
}

fn between(lower: &Sheet, upper: &Sheet, z: f64) -> Sheet {
    let f = (z - lower.z) / (upper.z - lower.z);
    Sheet {
        z,
        slope: lower.slope + (upper.slope - lower.slope) * f,
        rate: lower.rate + (upper.rate - lower.rate) * f,
    }
}
