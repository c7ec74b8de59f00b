//! A channel in an area: its mean flow, its eddies, the remaining diffusivity, and the walls.
//!
//! *Source*: those of `channel` and `eddies`.
//!
//! *Parameters*: those of `channel`.
//!
//! *Deviations*: with resolved eddies, only what they omit mixes as a diffusivity, K(z) vertically and its depth mean
//! horizontally. Without them, Elder's vertical and Fischer's transverse diffusivity represent all of the turbulence.

use world::fields::SideWalls;

use crate::flow::channel::{Channel, TRANSVERSE};
use crate::flow::eddies::{Eddies, Spectrum};
use crate::flow::mixing;

/// A channel between walls, with its eddies.
#[derive(Clone, Debug)]
pub(crate) struct Flume {
    pub(crate) channel: Channel,
    pub(crate) eddies: Option<Eddies>,
    pub(crate) walls: SideWalls,
    /// Horizontal diffusivity of what is not resolved, m²/s.
    pub(crate) k_h: f64,
}

impl Flume {
    /// A channel with these eddies.
    pub(crate) fn new(channel: Channel, eddies: Option<Eddies>, walls: SideWalls) -> Self {
        let k_h = match &eddies {
            Some(eddies) => channel.mean_of(|z| Spectrum::beyond(&channel, z, eddies.finest())),
            None => TRANSVERSE * channel.u_star_m_s * channel.depth_m,
        };
        Self { channel, eddies, walls, k_h }
    }

    /// Diffusivity by which filaments of a size grow, m²/s: that of all unresolved eddies or, where small ones carry
    /// filaments, that of the eddies smaller than the size.
    pub(crate) fn stirring(&self, size_m: f64) -> f64 {
        match &self.eddies {
            Some(eddies) if eddies.small().is_some() => {
                let c = &self.channel;
                c.mean_of(|z| Spectrum::beyond(c, z, 1.0 / size_m))
            }
            _ => self.k_h,
        }
    }

    /// Vertical diffusivity of what is not resolved, m²/s.
    pub(crate) fn vertical(&self, height_m: f64) -> f64 {
        let c = &self.channel;
        match &self.eddies {
            Some(eddies) => Spectrum::beyond(c, height_m, eddies.finest()),
            None => mixing::parabolic(c.u_star_m_s, height_m, c.depth_m),
        }
    }
}
