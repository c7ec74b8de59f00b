//! What a strategy shows of itself to figures, recording and live state. Nothing of it moves the vehicle.

pub(super) mod layers;
pub(super) mod regions;
pub(super) mod zone;

use layers::Layer;
use nalgebra::{Vector2, Vector3};
use regions::Regions;
use zone::Zone;

/// What a strategy shows beside its decision. What it does not have is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// Points where the plume was lost, as it believes (east, north), m.
    pub lost_points: Vec<Vector2<f64>>,
    /// What the declaration rule looked at last.
    pub zone: Zone,
    /// The path that it plans to follow (ENU), m, beginning with the vehicle's place at planning time.
    pub planned: Vec<Vector3<f64>>,
    /// The subregions of the mission.
    pub regions: Regions,
    /// The layers of a subsumption planner, lowest first.
    pub layers: Vec<Layer>,
}
