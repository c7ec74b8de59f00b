//! What a current is to the water: parameters that say something before it is made, and join the water.

use nalgebra::Vector2;
use world::area::Area;
use world::cost::{Cost, Times};
use world::registry::Spec;
use world::seeds::Seed;
use world::terrain::Terrain;

use crate::error::PlumeError;
use crate::flow::free_water::FreeWater;
use crate::flow::grid::CurrentScales;

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
    /// Mean of the currents that carry it (east, north), m/s; zero for those that nothing carries.
    pub carrier: Vector2<f64>,
}

impl CurrentSlot<'_> {
    /// A mistake of the current as a whole.
    pub(super) fn wrong<T>(&self, problem: &str) -> Result<T, PlumeError> {
        Err(PlumeError::new(self.field, problem))
    }
}

/// Parameters of a current, and what they say of it before it is made. The current must follow from them and from its
/// [`CurrentSlot`] alone, because runs with the same parameters, place and seed share spin-ups, also from the disk.
pub trait CurrentParams: Spec {
    /// Takes its part in the water; currents join in the order of the scenario.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    fn join(&self, water: &mut FreeWater, place: &CurrentSlot) -> Result<(), PlumeError>;

    /// Whether the mean of all others carries it: it joins when those have.
    fn is_carried(&self) -> bool {
        false
    }

    /// Whether it never changes; waves pass by without turning the water.
    fn is_steady(&self) -> bool {
        false
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
