//! The currents a scenario can ask for.

use nalgebra::Vector2;
use world::area::Area;
use world::catalogue::Entry;
use world::cost::{Cost, Times};
use world::kind;
use world::registry::Spec;
use world::seeds::Seed;
use world::terrain::Terrain;

use crate::error::PlumeError;
use crate::flow::channel::OpenChannelSpec;
use crate::flow::layered::LayeredSpec;
use crate::flow::meander::MeanderSpec;
use crate::flow::tide::TideSpec;
use crate::flow::uniform::UniformSpec;
use crate::flow::water::Water;
use crate::flow::waves::WavesSpec;

/// Where a current joins the water.
#[derive(Clone, Copy, Debug)]
pub struct CurrentSlot<'a> {
    /// Its path in the scenario, such as `water.currents[0]`.
    pub field: &'a str,
    /// The operating area.
    pub area: &'a Area,
    /// The bed.
    pub terrain: &'a Terrain,
    /// Seed of the run.
    pub seed: Seed,
}

impl CurrentSlot<'_> {
    /// A mistake of the current as a whole.
    pub(super) fn wrong<T>(&self, problem: &str) -> Result<T, PlumeError> {
        Err(PlumeError::Invalid { field: self.field.to_owned(), problem: problem.to_owned() })
    }
}

/// A current that is the same at all depths and known at all times; [`Water::add`] takes one in.
pub trait PlaneCurrent: std::fmt::Debug + Send + Sync {
    /// (east, north) at (east, north) `p` at time `t_s`, m/s.
    fn velocity(&self, p: Vector2<f64>, t_s: f64) -> Vector2<f64>;

    /// Whether it never changes.
    fn is_steady(&self) -> bool {
        false
    }
}

/// The shortest lengths and times over which a current changes.
#[derive(Clone, Debug, PartialEq)]
pub struct CurrentScales {
    /// Length of the shortest wave that turns it, m; infinite without waves.
    pub shortest_m: f64,
    /// Shortest period of these waves, s; infinite without waves.
    pub shortest_s: f64,
    /// The interfaces between layers.
    pub interfaces: Vec<InterfaceScale>,
}

/// Where an interface is, and over which height the current changes in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterfaceScale {
    /// Mean depth, m.
    pub depth_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
}

impl Default for CurrentScales {
    fn default() -> Self {
        Self { shortest_m: f64::INFINITY, shortest_s: f64::INFINITY, interfaces: Vec::new() }
    }
}

/// Parameters of a current, and what they say of it before it is made. The current must follow from them and from its
/// [`CurrentSlot`] alone, because runs with the same parameters, place and seed share spin-ups, also from the disk.
pub trait CurrentParams: Spec {
    /// Takes its part in the water; currents join in the order of the scenario.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    fn join(&self, water: &mut Water, place: &CurrentSlot) -> Result<(), PlumeError>;

    /// The same for one that the mean of all others carries: it joins when those have.
    ///
    /// # Errors
    /// As [`Self::join`].
    fn join_carried(&self, _water: &mut Water, _place: &CurrentSlot, _carrier: Vector2<f64>) -> Result<(), PlumeError> {
        Ok(())
    }

    /// Whether it never changes; waves pass by without turning the water.
    fn is_steady(&self) -> bool {
        true
    }

    /// Whether the area's sides are its walls.
    fn is_walled(&self) -> bool {
        false
    }

    /// Surface waves that are summed wherever the water is asked.
    fn waves(&self) -> f64 {
        0.0
    }

    /// How fast it carries things away (east, north), m/s, if it keeps its direction.
    fn carries_m_s(&self) -> Vector2<f64> {
        Vector2::zeros()
    }

    /// The shortest lengths and times over which it changes: so finely the plume sees it.
    fn scales(&self) -> CurrentScales {
        CurrentScales::default()
    }

    /// What it takes, where it is asked for up to `ahead_s` beyond the usual; paths begin with its own fields.
    fn cost(&self, _area: &Area, _depth_m: f64, _ahead_s: f64, _times: &Times) -> Cost {
        Cost::default()
    }
}

kind! {
    /// Currents, waves and turbulence. A scenario lists one or more, and their velocities add up.
    pub CurrentSpec = Currents of CurrentParams {
        heading: "Flows",
        rows: [UniformSpec, LayeredSpec, MeanderSpec, OpenChannelSpec, TideSpec, WavesSpec],
    }
}

/// What a scenario may say of the water beside its currents, by its field in `water`.
pub const OPTIONS: &[Entry] = &[Entry {
    name: "blockage",
    what: "Obstacles and bed turn the currents aside: free of divergence, tangent to all that is solid; without it water passes through",
    source: "Sherman 1978, J. Appl. Meteorol. 17, 312 (mass-consistent wind fields); Chorin 1968, Math. Comp. 22, 745",
}];
