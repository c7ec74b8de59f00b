//! An open channel as a scenario asks for it.
//!
//! *Source*: see `channel`.
//!
//! *Parameters*: `mean_m_s` mean over the depth (m/s), `heading_deg` where the water goes, `roughness_m` k_s (m; 0
//! smooth), `viscosity_m2_s` ν (m²/s), `eddies` the resolved turbulence (file `eddies`). The sides of the area are the
//! channel's walls.
//!
//! *Deviations*: u_* is solved so that the profile has the given depth mean.

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::catalogue::Entry;
use world::cost::{Cost, Times};
use world::fields::SideWalls;
use world::math;
use world::ranges::{HeadingDeg, NonNegative, Positive};
use world::registry::Listed;
use world::terrain::Terrain;

use super::flume::Flume;
use crate::error::PlumeError;
use crate::flow::channel::Channel;
use crate::flow::current::{CurrentParams, CurrentSlot};
use crate::flow::eddies::EddiesSpec;
use crate::flow::free_water::FreeWater;

/// A channel between two walls.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OpenChannelSpec {
    /// Mean over the depth, m/s.
    #[serde(with = "world::limits::running_m_s")]
    pub mean_m_s: Positive,
    /// Where the water goes: along the area's axis.
    #[serde(default = "east")]
    pub heading_deg: HeadingDeg,
    /// Equivalent sand roughness k_s, m; 0 means a smooth bed.
    #[serde(default = "smooth", with = "world::limits::sand_m")]
    pub roughness_m: NonNegative,
    /// Kinematic viscosity, m²/s.
    #[serde(default = "water", with = "world::limits::viscosity_m2_s")]
    pub viscosity_m2_s: Positive,
    /// Resolved turbulence; without it, all turbulence is diffusivity.
    #[serde(default)]
    pub eddies: Option<EddiesSpec>,
}

const fn east() -> HeadingDeg {
    HeadingDeg::new(90.0)
}

const fn smooth() -> NonNegative {
    NonNegative::new(0.0)
}

const fn water() -> Positive {
    Positive::new(1e-6)
}

impl Listed for OpenChannelSpec {
    const ENTRY: Entry = Entry {
        name: "OpenChannel",
        what: "Flume or canal between walls: log law over a smooth or rough bed, and turbulence resolved by random Fourier modes",
        source: "Nezu & Nakagawa 1993, Turbulence in Open-Channel Flows; Fung et al. 1992, J. Fluid Mech. 236, 281",
    };
}

impl CurrentParams for OpenChannelSpec {
    fn join(&self, water: &mut FreeWater, place: &CurrentSlot) -> Result<(), PlumeError> {
        if water.stands_at_bed() {
            return place.wrong(
                "an OpenChannel brings its own bed friction and there can be only one: leave out water.bed and any other OpenChannel",
            );
        }
        let CurrentSlot { field, area, seed, .. } = *place;
        let Terrain::Level { depth_m } = *place.terrain else {
            return place.wrong("an OpenChannel needs a level bed: terrain: Level(depth_m: ...)");
        };
        let channel = self.build(field, depth_m)?;
        let axis = area.axis.unit();
        if channel.along.dot(&axis).abs() < 1.0 - 1e-9 {
            let problem = format!(
                "an OpenChannel flows along the area's axis, {} or {} degrees, got {}",
                area.axis.deg(),
                (area.axis.deg() + 180.0).rem_euclid(360.0),
                self.heading_deg.get()
            );
            return Err(PlumeError::new(format!("{field}.heading_deg"), problem));
        }
        let eddies = (self.eddies.as_ref()).map(|e| e.build(field, area, &channel, seed)).transpose()?;
        let walls = SideWalls {
            centre: area.centre,
            across: Vector2::new(-channel.along.y, channel.along.x),
            half_width_m: area.width_m / 2.0,
        };
        water.flume = Some(Flume::new(channel, eddies, walls));
        Ok(())
    }

    fn is_steady(&self) -> bool {
        true
    }

    fn is_walled(&self) -> bool {
        true
    }

    fn carries_m_s(&self) -> Vector2<f64> {
        self.heading_deg.heading().unit() * self.mean_m_s.get()
    }

    fn cost(&self, area: &Area, depth_m: f64, _: f64, _: &Times) -> Cost {
        let eddies = self.eddies.as_ref();
        eddies.map_or_else(Cost::default, |e| e.cost(area, depth_m).under("eddies"))
    }
}

impl OpenChannelSpec {
    /// The mean flow over a level bed at `depth_m`, checked.
    ///
    /// # Errors
    /// If the roughness is not small compared with the depth, or if no friction velocity gives the wanted mean.
    pub fn build(&self, field: &str, depth_m: f64) -> Result<Channel, PlumeError> {
        let k_s = self.roughness_m.get();
        if k_s > 0.5 * depth_m {
            let most = 0.5 * depth_m;
            let problem =
                format!("must be >= 0 and at most {most} (half the depth: beyond, there is no log law), got {k_s}");
            return Err(PlumeError::new(format!("{field}.roughness_m"), problem));
        }
        let nu = self.viscosity_m2_s.get();
        let mean = self.mean_m_s.get();
        let reynolds = mean * depth_m / nu;
        // Below about 500 open channels are laminar, above 2000 turbulent (Chow 1959, Open-Channel Hydraulics, ch. 1).
        if reynolds < 2000.0 {
            let problem = format!(
                "gives a Reynolds number of {reynolds:.0}, must be >= {} for a turbulent channel {depth_m} m deep, got {mean}",
                2000.0 * nu / depth_m
            );
            return Err(PlumeError::new(format!("{field}.mean_m_s"), problem));
        }
        let at = |u_star: f64| Channel {
            along: self.heading_deg.heading().unit(),
            mean_m_s: mean,
            depth_m,
            u_star_m_s: u_star,
            viscosity_m2_s: nu,
            z0: roughness_length(u_star, k_s, nu),
        };
        let (mut low, mut high) = (0.0, mean);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if at(middle).depth_mean() < mean {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(at(0.5 * (low + high)))
    }
}

fn roughness_length(u_star: f64, k_s: f64, nu: f64) -> f64 {
    nu / (9.0 * u_star.max(1e-12)) + k_s / 30.0 * (1.0 - math::exp(-u_star * k_s / (27.0 * nu)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::bed::KARMAN;

    fn channel(mean: f64, roughness: f64) -> Channel {
        OpenChannelSpec {
            mean_m_s: Positive::new(mean),
            heading_deg: east(),
            roughness_m: NonNegative::new(roughness),
            viscosity_m2_s: water(),
            eddies: None,
        }
        .build("water.currents[0]", 0.2)
        .unwrap()
    }

    /// The flume of Webster et al. 2012: 2.8 mm/s by the usual constants, about 3 in the paper; ours is within 5 % of
    /// the former.
    #[test]
    fn friction_velocity_gives_the_mean() {
        let c = channel(0.05, 0.0);
        assert!((c.u_star_m_s / 0.0028 - 1.0).abs() < 0.05, "{}", c.u_star_m_s);
        assert!((c.mean_of(|z| c.speed(z)) - 0.05).abs() < 1e-4);
        // 0.01 m of sand in fully rough flow: u/u_* = ln(30z/k_s)/κ.
        let rough = channel(0.5, 0.01);
        let want = rough.u_star_m_s / KARMAN * math::ln(30.0 * 0.1 / 0.01);
        assert!((rough.speed(0.1) / want - 1.0).abs() < 0.01);
        assert!(rough.u_star_m_s > 1.3 * channel(0.5, 0.0).u_star_m_s);
    }

    #[test]
    fn sublayer_is_viscous_and_joins_the_log_law() {
        let c = channel(0.05, 0.0);
        let unit = c.viscosity_m2_s / c.u_star_m_s;
        assert!((c.speed(5.0 * unit) / (5.0 * c.u_star_m_s) - 1.0).abs() < 1e-9);
        let (below, above) = (c.speed(11.6 * unit), c.speed(11.7 * unit));
        assert!(above > below && (above / below - 1.0).abs() < 0.02);
        assert_eq!(c.speed(0.0), 0.0);
        assert_eq!(c.speed(9.0), c.speed(0.2));
    }

    /// Nezu & Nakagawa's energy is half the sum of their squares (they print 4.78), and production equals dissipation
    /// near the bed.
    #[test]
    fn turbulence_is_consistent() {
        let c = channel(0.05, 0.0);
        let sum: f64 = c.intensities(0.05).iter().map(|v| v * v).sum();
        assert!((0.5 * sum / c.energy(0.05) - 1.0).abs() < 0.01);
        let u3 = c.u_star_m_s.powi(3);
        assert!((c.dissipation(0.02) / (u3 / (KARMAN * 0.02)) - 1.0).abs() < 0.3);
    }
}
