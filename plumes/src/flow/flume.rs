//! A channel in an area: its mean flow, its eddies, the remaining diffusivity, and the walls.
//!
//! *Source*: those of `channel` and `eddies`.
//!
//! *Parameters*: those of `channel`.
//!
//! *Deviations*: with resolved eddies, only what they omit mixes as a diffusivity, K(z) vertically and its depth mean
//! horizontally. Without them, Elder's vertical and Fischer's transverse diffusivity represent all of the turbulence.

use nalgebra::Vector2;
use world::area::Area;
use world::fields::SideWalls;
use world::seeds::Seed;
use world::terrain::Terrain;

use crate::error::PlumeError;
use crate::flow::channel::{Channel, TRANSVERSE};
use crate::flow::eddies::{Eddies, Spectrum};
use crate::flow::mixing;
use crate::flow::open_channel::OpenChannelSpec;

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
    pub(crate) fn build(
        spec: &OpenChannelSpec,
        field: &str,
        area: &Area,
        terrain: &Terrain,
        alone: bool,
        seed: Seed,
    ) -> Result<Self, PlumeError> {
        let bad = |problem: &str| PlumeError::Invalid { field: field.to_owned(), problem: problem.to_owned() };
        if !alone {
            return Err(bad(
                "an OpenChannel brings its own bed friction and there can be only one: leave out water.bed and any other OpenChannel",
            ));
        }
        let Terrain::Level { depth_m } = *terrain else {
            return Err(bad("an OpenChannel needs a level bed: terrain: Level(depth_m: ...)"));
        };
        let channel = spec.build(field, depth_m)?;
        let axis = area.axis.unit();
        if channel.along.dot(&axis).abs() < 1.0 - 1e-9 {
            return Err(PlumeError::Invalid {
                field: format!("{field}.heading_deg"),
                problem: format!(
                    "an OpenChannel flows along the area's axis, {} or {} degrees, got {}",
                    area.axis.deg(),
                    (area.axis.deg() + 180.0).rem_euclid(360.0),
                    spec.heading_deg.get()
                ),
            });
        }
        let eddies = (spec.eddies.as_ref()).map(|e| e.build(field, area, &channel, seed)).transpose()?;
        let k_h = match &eddies {
            Some(eddies) => channel.mean_of(|z| Spectrum::beyond(&channel, z, eddies.finest())),
            None => TRANSVERSE * channel.u_star_m_s * depth_m,
        };
        let walls = SideWalls {
            centre: area.centre,
            across: Vector2::new(-channel.along.y, channel.along.x),
            half_width_m: area.width_m / 2.0,
        };
        Ok(Self { channel, eddies, walls, k_h })
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
