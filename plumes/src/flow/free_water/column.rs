//! The water over one place at one time, asked at heights.
//!
//! *Source*: as `free_water`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none of its own.

use super::Column;
use crate::flow::bed::KARMAN;
use crate::flow::layered::{LayeredColumn, Profile, Sheet};
use crate::flow::mixing;
use crate::flow::number::{Number, dot, still, times};
use nalgebra::{Vector2, Vector3};
use world::fields::Mixing;

impl<N: Number> Column<'_, N> {
    /// The part of the layers in the current, m/s.
    fn layered(&self, z: N) -> Vector2<N> {
        let layers = self.layers.as_ref();
        layers.map_or(still(Vector2::zeros()), |layers| layers.velocity(z))
    }

    pub(super) fn inside(&self, z: N) -> N {
        z.within(self.floor.z, N::from(0.0))
    }

    /// Velocity at a height, m/s.
    pub fn velocity(&self, z: N) -> Vector3<N> {
        let z = self.inside(z);
        self.velocity_in(z, self.layered(z))
    }

    /// Velocity at a height in the water, of which the layers are this part.
    fn velocity_in(&self, z: N, layered: Vector2<N>) -> Vector3<N> {
        let bed = self.water.bed;
        let factor = bed.map_or(N::from(1.0), |bed| bed.factor(z - self.floor.z, -self.floor.z));
        let mut u = (self.plane + layered) * factor;
        if let Some(flume) = &self.water.flume {
            u += times(flume.channel.along, flume.channel.speed(z - self.floor.z));
        }
        let (slope, rate) = match &self.layers {
            Some(layers) => {
                let sheet = layers.sheet(z, &self.floor);
                (sheet.slope, sheet.rate)
            }
            None => (self.floor.slope * (z / self.floor.z), N::from(0.0)),
        };
        Vector3::new(u.x, u.y, rate + dot(u, slope))
    }

    /// Density at a height, kg/m³.
    pub fn density(&self, z: N) -> f64 {
        let layers = self.layers.as_ref();
        layers.map_or(self.water.density, |l| l.density(self.inside(z)))
    }
}

impl Column<'_> {
    /// Height of the bed, m.
    pub fn bed_z(&self) -> f64 {
        self.floor.z
    }

    /// The interfaces between the layers, top first.
    pub fn interfaces(&self) -> &[Sheet] {
        self.layers.as_ref().map_or(&[], LayeredColumn::faces)
    }

    /// Horizontal current as it would be without bed friction, m/s.
    pub(super) fn free(&self, z: f64) -> Vector2<f64> {
        self.plane + self.layered(z)
    }

    pub(super) fn profile(&self, z: f64) -> Option<Profile> {
        self.layers.as_ref().map(|l| l.profile(z))
    }

    /// Friction velocity at the bed, m/s; zero without bed friction.
    pub fn friction_velocity(&self) -> f64 {
        if let Some(flume) = &self.water.flume {
            return flume.channel.u_star_m_s;
        }
        self.water.bed.map_or(0.0, |bed| {
            let depth = -self.floor.z;
            let speed = self.free(self.floor.z + bed.top(depth)).norm();
            bed.friction_velocity(speed, depth)
        })
    }

    /// Diffusivities at a height, given the column's friction velocity.
    pub fn mixing(&self, z: f64, u_star_m_s: f64) -> Mixing {
        let z = self.inside(z);
        self.mixing_in(z, u_star_m_s, self.profile(z).as_ref())
    }

    /// Velocity and diffusivities at a height, as from both methods, with the profile computed only once.
    pub(in crate::flow) fn both(&self, z: f64, u_star_m_s: f64) -> (Vector3<f64>, Mixing) {
        let z = self.inside(z);
        let profile = self.profile(z);
        let profile = profile.as_ref();
        (self.velocity_in(z, profile.map_or(Vector2::zeros(), |p| p.u)), self.mixing_in(z, u_star_m_s, profile))
    }

    /// Lets through interfaces that are thinner than the way between two heights no more than they do: between two heights
    /// with an interface between them, the diffusivity is that of both layers and the interface in series.
    pub(in crate::flow) fn keep_apart(&self, u_star_m_s: f64, heights_m: &[f64], out: &mut [(Vector3<f64>, Mixing)]) {
        for (z, thickness_m) in self.layers.iter().flat_map(LayeredColumn::stops) {
            let above = heights_m.partition_point(|h| *h < z);
            if above == 0 || above == heights_m.len() {
                continue;
            }
            let way_m = heights_m[above] - heights_m[above - 1];
            if way_m <= thickness_m {
                continue;
            }
            let inside = self.mixing(z, u_star_m_s).k_z_m2_s;
            for (_, mixing) in &mut out[above - 1..=above] {
                let k_z = &mut mixing.k_z_m2_s;
                let resistance = thickness_m / inside + (way_m - thickness_m) / *k_z;
                *k_z = k_z.min(way_m / resistance);
            }
        }
    }

    fn mixing_in(&self, z: f64, u_star_m_s: f64, profile: Option<&Profile>) -> Mixing {
        let (height, depth) = (z - self.floor.z, -self.floor.z);
        let reach = self.layers.as_ref().and_then(LayeredColumn::lid);
        let reach = reach.map_or(depth, |lid| lid - self.floor.z);
        let flume = self.water.flume.as_ref();
        let mut k_z =
            flume.map_or_else(|| mixing::parabolic(u_star_m_s, height, reach), |flume| flume.vertical(height));
        if let Some(waves) = &self.water.waves {
            k_z += waves.vertical(z);
        }
        if k_z > 0.0
            && let Some(p) = profile
        {
            let wall = u_star_m_s / (KARMAN * height);
            let shear2 = p.du_dz.norm_squared() + wall * wall;
            k_z *= mixing::damping(mixing::richardson(p.drho_dz, p.density, shear2));
        }
        let spec = &self.water.mixing;
        Mixing {
            k_h_m2_s: spec.horizontal_m2_s.get()
                + spec.transverse.get() * u_star_m_s * depth
                + flume.map_or(0.0, |flume| flume.k_h),
            k_z_m2_s: spec.background_vertical_m2_s.get() + k_z,
        }
    }
}
