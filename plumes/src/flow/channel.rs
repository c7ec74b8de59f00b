//! An open channel: its mean profile over a smooth or rough bed, and the turbulence that goes with it.
//!
//! *Source*: log law with the roughness length of Christoffersen & Jonsson 1985, Ocean Eng. 12, 387 (Soulsby 1997,
//! Dynamics of Marine Sands, eq. 23b): z0 = ν/(9u_*) + (k_s/30)(1 − exp(−u_*k_s/(27ν))); below it the viscous sublayer
//! u = u_*²z/ν (Schlichting, Boundary-Layer Theory, ch. 17). Intensities u′, v′, w′ = (2.30, 1.63, 1.27) u_* e^(−z/H),
//! k = 4.78 u_*² e^(−2z/H), ε = 9.8 (u_*³/H)(z/H)^(−½) e^(−3z/H): Nezu & Nakagawa 1993, Turbulence in Open-Channel
//! Flows, ch. 4. Diffusivity without resolved eddies: K_z of Elder 1959, J. Fluid Mech. 5, 544, transverse 0.15 u_*H,
//! Fischer et al. 1979, section 5.1.
//!
//! *Parameters*: see `open_channel`.
//!
//! *Deviations*: there is no wake and no dip at the
//! surface, and the boundary layers of the side walls are omitted: the mean is the same across the channel. Sublayer
//! and log law meet where they cross (11.6 wall units on a smooth bed), with a kink.

pub(super) mod flume;
pub mod open_channel;

use nalgebra::Vector2;
use world::math;

use crate::flow::bed::KARMAN;
use crate::flow::number::Number;

/// Intensities at the bed in units of u_*: along, across, up (Nezu & Nakagawa 1993).
pub const INTENSITIES: [f64; 3] = [2.30, 1.63, 1.27];
/// Fischer's transverse diffusivity in units of u_*H.
pub const TRANSVERSE: f64 = 0.15;

/// The channel's mean flow and the scales of its turbulence, ready to use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// Unit vector (east, north) of the stream.
    pub along: Vector2<f64>,
    /// Mean over the depth, m/s.
    pub mean_m_s: f64,
    /// Depth H, m.
    pub depth_m: f64,
    /// Friction velocity, m/s.
    pub u_star_m_s: f64,
    /// Kinematic viscosity, m²/s.
    pub viscosity_m2_s: f64,
    pub(super) z0: f64,
}

impl Channel {
    /// Mean speed at a height above the bed, m/s.
    pub fn speed<N: Number>(&self, height_m: N) -> N {
        let h = height_m.within(N::from(0.0), N::from(self.depth_m));
        let viscous = h * (self.u_star_m_s * self.u_star_m_s) / self.viscosity_m2_s;
        let log = (h / self.z0).greatest(N::from(1.0)).ln() * (self.u_star_m_s / KARMAN);
        // Below its zero the log law, and with it the water, stands still: on a smooth bed, a ninth of a wall unit.
        viscous.least(log)
    }

    pub(super) fn depth_mean(&self) -> f64 {
        const N: usize = 400;
        // Denser at the bed: heights are proportional to the square.
        let cells = (0..N).map(|k| {
            let s = (k as f64 + 0.5) / N as f64;
            self.speed(self.depth_m * s * s) * 2.0 * s
        });
        cells.sum::<f64>() / N as f64
    }

    /// Intensities (along, across, up) at a height above the bed, m/s.
    pub fn intensities(&self, height_m: f64) -> [f64; 3] {
        let fall = math::exp(-height_m / self.depth_m);
        INTENSITIES.map(|c| c * self.u_star_m_s * fall)
    }

    /// Turbulent energy at a height, m²/s².
    pub fn energy(&self, height_m: f64) -> f64 {
        4.78 * self.u_star_m_s * self.u_star_m_s * math::exp(-2.0 * height_m / self.depth_m)
    }

    /// Dissipation at a height, m²/s³; within a twentieth of the depth from the bed, that at the twentieth.
    pub fn dissipation(&self, height_m: f64) -> f64 {
        let xi = (height_m / self.depth_m).max(0.05);
        let u3 = self.u_star_m_s * self.u_star_m_s * self.u_star_m_s;
        9.8 * u3 / self.depth_m / xi.sqrt() * math::exp(-3.0 * xi)
    }

    /// Mean over the depth of a function of the height above the bed.
    pub fn mean_of(&self, f: impl Fn(f64) -> f64) -> f64 {
        const N: usize = 100;
        let heights = (0..N).map(|k| (k as f64 + 0.5) / N as f64 * self.depth_m);
        heights.map(f).sum::<f64>() / N as f64
    }
}
