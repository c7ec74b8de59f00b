//! A gantry in a scenario.

use super::id::Id;
use nalgebra::{Vector2, Vector3};
use robots::handoff::GantryLayout;
use robots::sense::ProbesSpec;
use robots::track::GantryStrategySpec;
use robots::vehicles::{Gantry, GantrySpec};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::frames::Pose;
use world::ranges::{Finite, HeadingDeg};
use world::terrain::Terrain;

/// A gantry: its frame and drives, where it stands, its probes, and its strategy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GantryBlock {
    /// Name, unique among gantries and robots.
    pub id: Id,
    /// Frame, drives and probe places.
    #[serde(default)]
    pub gantry: GantrySpec,
    /// Where it stands in the flume.
    pub place: PlaceSpec,
    /// Where the head is when the trial starts.
    #[serde(default)]
    pub start: HeadSpec,
    /// Its probes.
    #[serde(default)]
    pub probes: ProbesSpec,
    /// What it does.
    pub tracker: GantryStrategySpec,
}

/// Where the origin of a gantry's URDF stands: on the bed, turned about the vertical.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaceSpec {
    /// East of the datum, m.
    #[serde(with = "world::limits::place_m")]
    pub east_m: Finite,
    /// North of the datum, m.
    #[serde(with = "world::limits::place_m")]
    pub north_m: Finite,
    /// Direction of its first axis, up-stream.
    pub heading_deg: HeadingDeg,
    /// Height of the origin above the bed, m. It raises all probes.
    #[serde(default = "zero")]
    pub raised_m: Finite,
}

fn zero() -> Finite {
    Finite::new(0.0)
}

/// Position of the head in the gantry's own frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HeadSpec {
    /// Along the first axis, m.
    pub forward_m: Finite,
    /// Across it, to the left, m.
    pub left_m: Finite,
}

impl Default for HeadSpec {
    fn default() -> Self {
        Self { forward_m: zero(), left_m: zero() }
    }
}

impl GantryBlock {
    /// What its searcher may know of the gantry.
    pub fn layout(&self, gantry: &Gantry) -> GantryLayout {
        gantry.layout(self.probes.rate_hz.get(), self.probes.range_v.map(Finite::get))
    }

    /// Pose of the gantry's base in the world.
    pub fn base(&self, terrain: &Terrain) -> Pose {
        let (x, y) = (self.place.east_m.get(), self.place.north_m.get());
        let p_W = Vector3::new(x, y, terrain.bed_z(x, y) + self.place.raised_m.get());
        Pose::level(p_W, self.place.heading_deg.heading())
    }

    /// Where the head starts (forward, left), m.
    pub fn start_m(&self) -> Vector2<f64> {
        Vector2::new(self.start.forward_m.get(), self.start.left_m.get())
    }
}
