//! Dissipation of turbulent energy in a column of water.
//!
//! *Source*: a flume has that of its profile (`channel`). Elsewhere the bed's turbulence dissipates what it takes from
//! the shear, K_z S², and the background mixing what Osborn 1980, J. Phys. Oceanogr. 10, 83, infers from it: K N²/0.2.
//!
//! *Parameters*: none.
//!
//! *Deviations*: the mixing by waves counts as if the shear of currents made it.

use super::Column;
use crate::flow::bed::KARMAN;
use world::units::GRAVITY_M_S2;

impl Column<'_> {
    /// Dissipation of turbulent energy at a height, given the column's friction velocity, m²/s³.
    pub fn dissipation(&self, z: f64, u_star_m_s: f64) -> f64 {
        let z = self.inside(z);
        let height = z - self.floor.z;
        if let Some(flume) = &self.water.flume {
            return flume.channel.dissipation(height);
        }
        let background = self.water.mixing.background_vertical_m2_s.get();
        let turbulent = self.mixing(z, u_star_m_s).k_z_m2_s - background;
        let (mut shear2, mut n2) = (0.0, 0.0);
        if height > 0.0 {
            let wall = u_star_m_s / (KARMAN * height);
            shear2 += wall * wall;
        }
        if let Some(p) = self.profile(z) {
            shear2 += p.du_dz.norm_squared();
            n2 = (-GRAVITY_M_S2 * p.drho_dz / p.density).max(0.0);
        }
        turbulent * shear2 + background * n2 / 0.2
    }
}
