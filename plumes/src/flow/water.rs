//! The whole water: currents, bed, layers and mixing combined into one answer.
//!
//! *Source*: sum of independent currents; flow tangent to the bed and to the moving interfaces, the kinematic condition
//! w = ∂η/∂t + u·∇η (Gill 1982, section 4.11).
//!
//! *Parameters*: [`WaterSpec`](super::WaterSpec): `currents`, `bed`, `mixing`, `density_kg_m3` (kg/m³, where no layers
//! set it), `blockage` (absent: the currents pass through obstacles).
//!
//! *Deviations*: the horizontal current is (uniform + tide + meander + layer) times the bed's log law, plus that of an
//! open channel, which has its own (files `channel`, `eddies`). The vertical current follows the surfaces that lie
//! linearly between bed, interfaces and still surface, w = ∂η/∂t + u·∇η on each, so water passes neither bed, interface
//! nor surface. Over a level bed, meander and boundary layer are free of divergence. The remaining divergence (off Duck
//! 1e-4 1/s rms, 1e-3 at worst) is: u·∇H/H over a sloping bed, because a current given as a speed is no transport;
//! second order in the interface's waves; and, inside the interface, the difference between a tanh-shaped change of
//! thickness and a straight w, which reverses with the wave. Below the bed and above the surface, the values at them
//! apply. Waves add their orbits to the velocity, and their drift and mixing to the plume's column (file `waves::sea`).

mod answers;
mod column;
mod dissipation;
mod kept;

use nalgebra::{Vector2, Vector3};
use std::sync::Arc;

use crate::flow::bed::BoundaryLayer;
use crate::flow::blockage::ObstacleFlow;
use crate::flow::channel::Channel;
use crate::flow::eddies::{Eddies, Small};
use crate::flow::flume::Flume;
use crate::flow::foreign::{ForeignCurrent, PlaneCurrent};
use crate::flow::ground::{Floor, Ground};
use crate::flow::layered::{Layered, LayeredColumn};
use crate::flow::meander::Meander;
use crate::flow::mixing::MixingSpec;
use crate::flow::number::{Number, still};
use crate::flow::tide::Tide;
use crate::flow::waves::Waves;

/// The water, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Water {
    pub(super) ground: Ground,
    pub(super) uniform: Vector2<f64>,
    pub(super) tides: Vec<Tide>,
    pub(super) meanders: Vec<Meander>,
    pub(super) layered: Option<Layered>,
    pub(super) bed: Option<BoundaryLayer>,
    pub(super) mixing: MixingSpec,
    pub(super) density: f64,
    pub(super) flume: Option<Flume>,
    pub(super) waves: Option<Waves>,
    pub(super) blocked: Option<ObstacleFlow>,
    /// Currents of no kind named above.
    pub(super) others: Vec<ForeignCurrent>,
}

/// The water over one place at one time; cheap to evaluate at many heights.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a, N = f64> {
    water: &'a Water,
    floor: Floor<N>,
    // Part of the current that is the same at all heights.
    plane: Vector2<N>,
    layers: Option<LayeredColumn<'a, N>>,
}

impl Water {
    /// Adds a current that is the same at all depths.
    pub fn add(&mut self, current: Arc<dyn PlaneCurrent>) {
        self.others.push(ForeignCurrent { name: "", current });
    }

    /// Gives those currents a name that have none yet.
    pub(super) fn name_others(&mut self, name: &'static str) {
        let nameless = self.others.iter_mut().filter(|o| o.name.is_empty());
        nameless.for_each(|o| o.name = name);
    }

    /// What is wrong with the currents of other crates at a place and a time. In the water they must be right.
    pub fn fault(&self, p: Vector2<f64>, t_s: f64) -> Option<String> {
        self.others.iter().find_map(|o| o.fault(p, t_s))
    }

    /// The channel, if the water is a channel.
    pub fn channel(&self) -> Option<&Channel> {
        self.flume.as_ref().map(|f| &f.channel)
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

    /// Velocity at a place and a time without the eddies of a channel, m/s: a check need not draw them.
    pub fn velocity_without_eddies(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let turned = (self.blocked.as_ref()).and_then(|blocked| blocked.velocity(p, &self.ground.floor(p.xy()), t_s));
        let mean = turned.unwrap_or_else(|| self.column(p.xy(), t_s).velocity(p.z));
        match &self.waves {
            Some(waves) => mean + waves.velocity(p, t_s),
            None => mean,
        }
    }

    fn eddying(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        self.eddies().map_or(Vector3::zeros(), |e| e.velocity(p, t_s))
    }

    /// The solution for the obstacles, if they divert the currents.
    pub fn blocked(&self) -> Option<&ObstacleFlow> {
        self.blocked.as_ref()
    }

    /// Whether its currents never change; passing waves do not count.
    pub(crate) fn is_steady(&self) -> bool {
        self.meanders.is_empty()
            && self.tides.is_empty()
            && self.others.iter().all(|o| o.current.is_steady())
            && self.layered.as_ref().is_none_or(Layered::is_steady)
    }

    /// Whether friction stops it at the bed.
    pub(crate) fn stands_at_bed(&self) -> bool {
        self.bed.is_some() || self.flume.is_some()
    }

    pub(crate) fn floor(&self, p: Vector2<f64>) -> Floor {
        self.ground.floor(p)
    }

    /// The water over (east, north) `p` at time `t_s`, its velocity as it would be without obstacles.
    pub fn column<N: Number>(&self, p: Vector2<N>, t_s: N) -> Column<'_, N> {
        let floor = self.ground.floor(p);
        let tides = self.tides.iter().map(|t| t.velocity(t_s));
        let wandering = tides.chain(self.meanders.iter().map(|m| m.velocity(p, t_s)));
        let wandering = wandering.chain(self.others.iter().map(|o| o.velocity(p, t_s)));
        Column {
            water: self,
            floor,
            plane: wandering.fold(still(self.uniform), |sum, u| sum + u),
            layers: self.layered.as_ref().map(|l| l.column(p, &floor, t_s)),
        }
    }

    /// Mean over the depth of the current at a place at time zero, without bed friction and meanders.
    pub(super) fn depth_mean(&self, p: Vector2<f64>) -> Vector2<f64> {
        const N: usize = 50;
        let column = self.column(p, 0.0);
        let heights = (0..N).map(|k| column.floor.z * (k as f64 + 0.5) / N as f64);
        let mean = heights.map(|z| column.free(z)).sum::<Vector2<f64>>() / N as f64;
        let channel = self.channel().map(|c| c.along * c.mean_m_s);
        mean + channel.unwrap_or_default()
    }
}
