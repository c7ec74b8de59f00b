//! The water as it would be without obstacles: currents, bed, layers and mixing combined into one answer.
//!
//! *Source*: sum of independent currents; flow tangent to the bed and to the moving interfaces, the kinematic condition
//! w = ∂η/∂t + u·∇η (Gill 1982, section 4.11).
//!
//! *Parameters*: [`WaterSpec`](super::WaterSpec): `currents`, `bed`, `mixing`, `density_kg_m3` (kg/m³, where no layers
//! set it).
//!
//! *Deviations*: the horizontal current is (all plane currents + layer) times the bed's log law, plus that of an open
//! channel, which has its own (files `channel`, `eddies`). The vertical current follows the surfaces that lie
//! linearly between bed, interfaces and still surface, w = ∂η/∂t + u·∇η on each, so water passes neither bed, interface
//! nor surface. Over a level bed, meander and boundary layer are free of divergence. The remaining divergence (off Duck
//! 1e-4 1/s rms, 1e-3 at worst) is: u·∇H/H over a sloping bed, because a current given as a speed is no transport;
//! second order in the interface's waves; and, inside the interface, the difference between a tanh-shaped change of
//! thickness and a straight w, which reverses with the wave. Below the bed and above the surface, the values at them
//! apply. Waves add their orbits to the velocity, and their drift and mixing to the plume's column (file `waves::sea`).

mod column;
mod dissipation;

use nalgebra::Vector2;
use std::sync::Arc;
use world::fields::SideWalls;

use super::channel::flume::Flume;
use crate::flow::bed::BoundaryLayer;
use crate::flow::channel::Channel;
use crate::flow::eddies::{Eddies, Small};
use crate::flow::ground::{Floor, Ground};
use crate::flow::layered::{Layered, LayeredColumn};
use crate::flow::mixing::MixingSpec;
use crate::flow::number::{Number, still};
use crate::flow::plane_current::{CurrentEntry, PlaneCurrent};
use crate::flow::waves::Waves;

/// The water without obstacles, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct FreeWater {
    pub(super) ground: Ground,
    /// Currents that are the same at all depths, in the order in which they are added up.
    pub(super) currents: Vec<CurrentEntry>,
    /// Layers set the density, and the surfaces that all of the water follows.
    pub(super) layers: Option<Layered>,
    pub(super) bed: Option<BoundaryLayer>,
    pub(super) mixing: MixingSpec,
    pub(super) density: f64,
    /// Walls on both sides, with the mean flow and the turbulence between them.
    pub(super) flume: Option<Flume>,
    pub(super) waves: Option<Waves>,
    /// Whether its currents never change; passing waves do not count.
    pub(super) steady: bool,
}

/// The water over one place at one time; cheap to evaluate at many heights.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a, N = f64> {
    water: &'a FreeWater,
    pub(super) floor: Floor<N>,
    // Part of the current that is the same at all heights.
    plane: Vector2<N>,
    layers: Option<LayeredColumn<'a, N>>,
}

impl FreeWater {
    /// Adds a current that is the same at all depths.
    pub fn add(&mut self, current: impl PlaneCurrent + 'static) {
        self.currents.push(CurrentEntry { name: "", is_own: true, current: Box::new(current) });
    }

    /// Brings the inner state of its currents up to `t_s`.
    pub(super) fn advance(&mut self, t_s: f64) {
        for entry in &mut self.currents {
            entry.current.advance(t_s);
        }
    }

    /// What is wrong with the currents of other crates at a place and a time. In the water they must be right.
    pub fn fault(&self, p: Vector2<f64>, t_s: f64) -> Option<String> {
        self.currents.iter().find_map(|c| c.fault(p, t_s))
    }

    /// The channel, if the water is a channel.
    pub fn channel(&self) -> Option<&Channel> {
        self.flume.as_ref().map(|f| &f.channel)
    }

    /// The walls of the channel.
    pub(super) fn side_walls(&self) -> Option<SideWalls> {
        self.flume.as_ref().map(|f| f.walls)
    }

    /// Its resolved eddies, if it has any.
    pub fn eddies(&self) -> Option<&Eddies> {
        self.flume.as_ref().and_then(|f| f.eddies.as_ref())
    }

    /// Makes what it draws at random with so many threads; the water is the same with any number.
    pub fn use_threads(&self, n: usize) {
        if let Some(eddies) = self.eddies() {
            eddies.use_threads(n);
        }
    }

    /// The eddies that only carry filaments, if there are any.
    pub fn small(&self) -> Option<&Arc<Small>> {
        self.eddies().and_then(Eddies::small)
    }

    /// The surface waves, if there are any.
    pub fn waves(&self) -> Option<&Waves> {
        self.waves.as_ref()
    }

    /// Whether friction stops it at the bed.
    pub(crate) fn stands_at_bed(&self) -> bool {
        self.bed.is_some() || self.flume.is_some()
    }

    pub(crate) fn floor(&self, p: Vector2<f64>) -> Floor {
        self.ground.floor(p)
    }

    /// The water over (east, north) `p` at time `t_s`.
    pub fn column<N: Number>(&self, p: Vector2<N>, t_s: N) -> Column<'_, N> {
        let floor = self.ground.floor(p);
        let currents = self.currents.iter().map(|c| c.velocity(p, t_s));
        Column {
            water: self,
            floor,
            plane: currents.fold(still(Vector2::zeros()), |sum, u| sum + u),
            layers: self.layers.as_ref().map(|l| l.column(p, &floor, t_s)),
        }
    }

    /// Mean over the depth of the current at a place at time zero, without bed friction.
    pub(super) fn depth_mean(&self, p: Vector2<f64>) -> Vector2<f64> {
        const N: usize = 50;
        let column = self.column(p, 0.0);
        let heights = (0..N).map(|k| column.floor.z * (k as f64 + 0.5) / N as f64);
        let mean = heights.map(|z| column.free(z)).sum::<Vector2<f64>>() / N as f64;
        let channel = self.channel().map(|c| c.along * c.mean_m_s);
        mean + channel.unwrap_or_default()
    }
}
