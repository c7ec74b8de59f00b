//! The layers at one place and time, asked at a height.
//!
//! *Source*: as `layers`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none of its own.

use super::layers::{LayeredColumn, Profile, Sheet};
use crate::flow::ground::Floor;
use crate::flow::number::Number;
use nalgebra::Vector2;

impl<N: Number> LayeredColumn<'_, N> {
    /// The interfaces, top first.
    pub fn faces(&self) -> &[Sheet<N>] {
        &self.faces[..self.of.faces.len()]
    }

    /// The share of the layer above an interface in the water at a height.
    fn share(&self, face: usize, z: N) -> N {
        // ½(1 + tanh(2x)) = 1/(1 + e^(−4x)), one exponential; its slope is 1/thickness in the middle. Far below, where
        // the share is less than 1e-152, the exponential and its slope would overflow.
        let x = (z - self.faces[face].z) / self.of.faces[face].thickness;
        N::from(1.0) / ((x * -4.0).least(N::from(350.0)).exp() + 1.0)
    }

    /// Horizontal velocity at a height, m/s: that of [`LayeredColumn::profile`], without the rest.
    pub fn velocity(&self, z: N) -> Vector2<N> {
        let n = self.of.u.len();
        (0..n - 1).fold(self.u[n - 1], |u, i| u + (self.u[i] - self.u[i + 1]) * self.share(i, z))
    }

    /// Density at a height, kg/m³: that of [`LayeredColumn::profile`], without the rest.
    pub fn density(&self, z: N) -> f64 {
        let rho = &self.of.density;
        (0..rho.len() - 1)
            .fold(rho[rho.len() - 1], |density, i| density + (rho[i] - rho[i + 1]) * self.share(i, z).value())
    }

    /// The layer-following surface through a height between floor and surface: linear between bed, interfaces and
    /// surface.
    pub fn sheet(&self, z: N, floor: &Floor<N>) -> Sheet<N> {
        let mut upper = Sheet::level(0.0);
        for lower in self.faces() {
            if z.value() >= lower.z.value() {
                return between(lower, &upper, z);
            }
            upper = *lower;
        }
        let bed = Sheet { z: floor.z, slope: floor.slope, rate: 0.0.into() };
        between(&bed, &upper, z)
    }
}

impl LayeredColumn<'_> {
    /// Height of the lowest interface across which the density changes, m. It limits the turbulence of the bed from
    /// above.
    pub fn lid(&self) -> Option<f64> {
        let rho = &self.of.density;
        let lowest = (0..self.of.faces.len()).rev().find(|&i| rho[i] < rho[i + 1]);
        lowest.map(|i| self.faces[i].z)
    }

    /// Heights and thicknesses of the interfaces across which the density changes, m, top first.
    pub(crate) fn stops(&self) -> impl Iterator<Item = (f64, f64)> {
        let rho = self.of.density.windows(2);
        let faces = self.faces().iter().zip(&self.of.faces).zip(rho);
        faces.filter(|(_, rho)| rho[0] < rho[1]).map(|((sheet, face), _)| (sheet.z, face.thickness))
    }

    /// Velocity, density and gradients at a height, m.
    pub fn profile(&self, z: f64) -> Profile {
        let n = self.of.u.len();
        let mut p =
            Profile { u: self.u[n - 1], du_dz: Vector2::zeros(), density: self.of.density[n - 1], drho_dz: 0.0 };
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
}

fn between<N: Number>(lower: &Sheet<N>, upper: &Sheet<N>, z: N) -> Sheet<N> {
    let f = (z - lower.z) / (upper.z - lower.z);
    Sheet { z, slope: lower.slope + (upper.slope - lower.slope) * f, rate: lower.rate + (upper.rate - lower.rate) * f }
}
