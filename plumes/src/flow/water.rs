//! The whole water: currents, bed, layers and mixing combined into one answer.
//!
//! *Source*: sum of independent currents; flow tangent to the bed and to the moving interfaces, the kinematic condition
//! w = ∂η/∂t + u·∇η (Gill 1982, section 4.11).
//!
//! *Parameters*: [`WaterSpec`]: `currents`, `bed`, `mixing`, `density_kg_m3` (kg/m³, where no layers set it),
//! `blockage` (absent: the currents pass through obstacles).
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
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use world::area::Area;
use world::fields::Flow;
use world::limits::range::stream_m_s;
use world::obstacles::Obstacles;
use world::ranges::Positive;
use world::seeds::Seed;
use world::terrain::Terrain;

use crate::error::PlumeError;
use crate::flow::bed::{BedSpec, BoundaryLayer};
use crate::flow::blockage::{BlockageSpec, ObstacleFlow};
use crate::flow::catalogue::{CurrentSlot, CurrentSpec, PlaneCurrent};
use crate::flow::channel::Channel;
use crate::flow::eddies::{Eddies, Small};
use crate::flow::flume::Flume;
use crate::flow::grid::GridShape;
use crate::flow::ground::{Floor, Ground};
use crate::flow::layered::{Layered, LayeredColumn};
use crate::flow::meander::Meander;
use crate::flow::mixing::MixingSpec;
use crate::flow::number::{Number, still};
use crate::flow::tide::Tide;
use crate::flow::waves::Waves;

/// The water of a scenario; still by default.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WaterSpec {
    /// Currents that add up; without any, the water is still.
    pub currents: Vec<CurrentSpec>,
    /// Bed friction; if absent, the currents slip.
    pub bed: Option<BedSpec>,
    /// Diffusivities.
    pub mixing: MixingSpec,
    /// Density where no layers set it, kg/m³.
    #[serde(with = "world::limits::density_kg_m3")]
    pub density_kg_m3: Positive,
    /// Obstacles and bed divert the currents; if absent, currents pass through obstacles.
    pub blockage: Option<BlockageSpec>,
}

impl Default for WaterSpec {
    fn default() -> Self {
        Self {
            currents: Vec::new(),
            bed: None,
            mixing: MixingSpec::default(),
            density_kg_m3: Positive::new(1026.0),
            blockage: None,
        }
    }
}

/// The water, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Water {
    pub(super) ground: Ground,
    pub(super) uniform: Vector2<f64>,
    pub(super) tides: Vec<Tide>,
    pub(super) meanders: Vec<Meander>,
    pub(super) layered: Option<Layered>,
    pub(super) bed: Option<BoundaryLayer>,
    mixing: MixingSpec,
    density: f64,
    pub(super) flume: Option<Flume>,
    pub(super) waves: Option<Waves>,
    blocked: Option<ObstacleFlow>,
    /// Currents of no kind named above.
    others: Vec<ForeignCurrent>,
}

/// A current of no kind of this crate, with its name in scenarios.
#[derive(Clone, Debug)]
struct ForeignCurrent {
    name: &'static str,
    current: Arc<dyn PlaneCurrent>,
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

impl WaterSpec {
    /// Whether the area's sides are the walls of a channel.
    #[must_use]
    pub fn is_walled(&self) -> bool {
        self.currents.iter().any(|c| c.is_walled())
    }

    /// The grid on which the plume sees the water, at most `depth_m` deep: one that shows the waves and interfaces of
    /// its currents or, round obstacles, the corners of the water's cells.
    #[must_use]
    pub fn grid_shape(&self, area: &Area, depth_m: f64) -> GridShape {
        let blockage = self.blockage.as_ref().map(BlockageSpec::grid_shape);
        blockage.unwrap_or_else(|| {
            let scales = self.currents.iter().map(|c| c.scales());
            scales.fold(GridShape::fitting(area), |shape, s| shape.resolving(&s, area, depth_m))
        })
    }

    /// The water round obstacles, if [`Self::blockage`] asks for it; otherwise as [`Self::build`] returns it.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    pub fn build_round(
        &self,
        area: &Area,
        terrain: &Terrain,
        obstacles: &Obstacles,
        seed: impl Into<Seed>,
    ) -> Result<Water, PlumeError> {
        let mut water = self.build(area, terrain, seed)?;
        if let Some(spec) = &self.blockage {
            let free = water.clone();
            water.blocked = Some(ObstacleFlow::new(spec, area, &free.ground, obstacles, free.clone())?);
        }
        Ok(water)
    }

    /// The water over a terrain as it would be without obstacles, checked.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    pub fn build(&self, area: &Area, terrain: &Terrain, seed: impl Into<Seed>) -> Result<Water, PlumeError> {
        let seed = seed.into();
        let bed = (self.bed.as_ref()).map(|b| b.build("water.bed")).transpose()?;
        let mut water = Water {
            ground: Ground::new(terrain),
            uniform: Vector2::zeros(),
            tides: Vec::new(),
            meanders: Vec::new(),
            layered: None,
            bed,
            mixing: self.mixing.clone(),
            density: self.density_kg_m3.get(),
            flume: None,
            waves: None,
            blocked: None,
            others: Vec::new(),
        };
        let fields: Vec<String> = (0..self.currents.len()).map(|i| format!("water.currents[{i}]")).collect();
        let place = |field| CurrentSlot { field, area, terrain, seed };
        for (current, field) in self.currents.iter().zip(&fields) {
            current.join(&mut water, &place(field))?;
            water.name_others(current.name());
        }
        if let Some(problem) = water.fault(area.centre, 0.0) {
            let field = "water.currents".to_string();
            return Err(PlumeError::Invalid { field, problem });
        }
        // Meanders last: the mean of the other currents carries them, wherever they stand in the list.
        let carrier = water.depth_mean(area.centre);
        for (current, field) in self.currents.iter().zip(&fields) {
            current.join_carried(&mut water, &place(field), carrier)?;
            water.name_others(current.name());
        }
        water.advance(0.0);
        Ok(water)
    }
}

impl Water {
    /// Adds a current that is the same at all depths.
    pub fn add(&mut self, current: Arc<dyn PlaneCurrent>) {
        self.others.push(ForeignCurrent { name: "", current });
    }

    /// Gives those currents a name that have none yet.
    fn name_others(&mut self, name: &'static str) {
        let nameless = self.others.iter_mut().filter(|o| o.name.is_empty());
        nameless.for_each(|o| o.name = name);
    }

    /// What is wrong with the currents of other crates at a place and a time. In the water they must be right.
    #[must_use]
    pub fn fault(&self, p: Vector2<f64>, t_s: f64) -> Option<String> {
        (self.others.iter()).find_map(|o| fault(o.name, p, t_s, o.current.velocity(p, t_s)))
    }

    /// The channel, if the water is a channel.
    #[must_use]
    pub fn channel(&self) -> Option<&Channel> {
        self.flume.as_ref().map(|f| &f.channel)
    }

    /// Its resolved eddies, if it has any.
    #[must_use]
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
    #[must_use]
    pub fn small(&self) -> Option<&Arc<Small>> {
        self.eddies().and_then(Eddies::small)
    }

    /// The surface waves, if there are any.
    #[must_use]
    pub fn waves(&self) -> Option<&Waves> {
        self.waves.as_ref()
    }

    /// Velocity at a place and a time without the eddies of a channel, m/s: a check need not draw them.
    #[must_use]
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
    #[must_use]
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
    #[must_use]
    pub fn column<N: Number>(&self, p: Vector2<N>, t_s: N) -> Column<'_, N> {
        let floor = self.ground.floor(p);
        let tides = self.tides.iter().map(|t| t.velocity(t_s));
        let wandering = tides.chain(self.meanders.iter().map(|m| m.velocity(p, t_s)));
        let wandering = wandering.chain(self.others.iter().map(|o| other(o, p, t_s)));
        Column {
            water: self,
            floor,
            plane: wandering.fold(still(self.uniform), |sum, u| sum + u),
            layers: self.layered.as_ref().map(|l| l.column(p, &floor, t_s)),
        }
    }

    /// Mean over the depth of the current at a place at time zero, without bed friction and meanders.
    fn depth_mean(&self, p: Vector2<f64>) -> Vector2<f64> {
        const N: usize = 50;
        let column = self.column(p, 0.0);
        let heights = (0..N).map(|k| column.floor.z * (k as f64 + 0.5) / N as f64);
        let mean = heights.map(|z| column.free(z)).sum::<Vector2<f64>>() / N as f64;
        let channel = self.channel().map(|c| c.along * c.mean_m_s);
        mean + channel.unwrap_or_default()
    }
}

/// What is wrong with a velocity of a current of another crate.
fn fault(name: &str, p: Vector2<f64>, t_s: f64, v: Vector2<f64>) -> Option<String> {
    let most = stream_m_s.1;
    // This form also refuses what is not a number.
    let wrong = !v.iter().all(|v| v.abs() <= most);
    wrong.then(|| {
        format!(
            "the current {name} flows at ({}, {}) m/s at east {} m, north {} m, {t_s} s: both must be within ±{most}; \
             correct the current",
            v.x, v.y, p.x, p.y
        )
    })
}

/// A current of which only values are known, as numbers that may ask for its slopes.
///
/// # Panics
/// If it flows faster than water does. A plume in such water would take steps without end.
fn other<N: Number>(other: &ForeignCurrent, p: Vector2<N>, t_s: N) -> Vector2<N> {
    /// Small compared with a current's scales, large compared with rounding at places of 10³ m; m and s.
    const H: f64 = 1e-3;
    let place = Vector2::new(p.x.value(), p.y.value());
    let ForeignCurrent { name, current } = other;
    let (now_s, here) = (t_s.value(), current.velocity(place, t_s.value()));
    let fault = fault(name, place, now_s, here);
    assert!(fault.is_none(), "{}", fault.unwrap_or_default());
    let part = |d: usize| {
        N::known(here[d], [p.x, p.y, t_s], || {
            let at = |dx: f64, dy: f64, dt: f64| current.velocity(place + Vector2::new(dx, dy), now_s + dt)[d];
            let back = H.min(now_s);
            [
                (at(H, 0.0, 0.0) - at(-H, 0.0, 0.0)) / (2.0 * H),
                (at(0.0, H, 0.0) - at(0.0, -H, 0.0)) / (2.0 * H),
                (at(0.0, 0.0, H) - at(0.0, 0.0, -back)) / (H + back),
            ]
        })
    };
    Vector2::new(part(0), part(1))
}
