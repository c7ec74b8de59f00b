//! Parameters of map and plan.

use super::super::setting::Setting;
use super::super::survey::AfterDeclaration;
use super::super::wishes::VerticalSpec;
use super::evade::EvadeSpec;
use crate::behave::FindSpec;
use crate::declare::BeliefRuleSpec;
use crate::error::{RobotError, require};
use crate::handoff::BeliefGrid;
use crate::plan::PlannerSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::area::Area;
use world::catalogue::Entry;
use world::limits::shown;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Most cells of a planner's room.
const MOST_CELLS: f64 = 4e6;
/// Greatest ratio of a cell's sides: the search's buckets grow with it.
const FLATTEST: f64 = 100.0;

/// Composition and parameters. A default with a section number is the paper's (Wang & Pang); the others are ours.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MapAndPlanSpec {
    /// Speed over ground, m/s (section III-B: 2).
    #[default(Positive::new(2.0))]
    pub speed_m_s: Positive,
    /// Altitude or depth; in a room of space, it holds only while there is no path.
    #[default(VerticalSpec::Altitude(Positive::new(2.0)))]
    pub vertical: VerticalSpec,
    /// Search for the plume until the first detection (section II-A: zig-zag).
    pub find: FindSpec,
    /// Cells of the planner.
    pub room: RoomSpec,
    /// The planner.
    pub planner: PlannerSpec,
    /// The declaration rule.
    pub declare: BeliefRuleSpec,
    /// Declare a cell only after the vehicle has been there, or as near as it can get. The paper does not ask for
    /// this, but its vehicle is always on its way for longer than the map must stay unchanged.
    #[default(true)]
    pub visit_first: bool,
    /// What to do at the believed source, until it is declared or believed elsewhere.
    pub at_target: AtTarget,
    /// What follows the declaration.
    pub after_declaration: AfterDeclaration,
    /// Hull radius with a margin for navigation and for wide turns, m.
    #[default(NonNegative::new(1.0))]
    pub hull_m: NonNegative,
    /// The vehicle steers to a point of the path this far ahead, m.
    #[default(Positive::new(6.0))]
    pub look_ahead_m: Positive,
    /// A place counts as reached within this distance, m.
    #[default(Positive::new(5.0))]
    pub arrive_m: Positive,
    /// The path is planned again when the vehicle is farther from it than this, m.
    #[default(Positive::new(8.0))]
    pub replan_off_m: Positive,
    /// Least time between two plans, s.
    #[default(NonNegative::new(1.0))]
    pub replan_s: NonNegative,
    /// Keeps away from solids that the path passes too closely for the vehicle's turning circle, and backs off from
    /// one that holds the vehicle. Without it the vehicle follows the path whatever lies beside it.
    pub evade: Option<EvadeSpec>,
}

impl Listed for MapAndPlanSpec {
    const ENTRY: Entry = Entry {
        name: "MapAndPlan",
        what: "zig-zag to the first detection, then planned paths to the map's likeliest cell, until a rule declares",
        source: "Wang & Pang, section II",
    };
}

/// The planner's cells, over the operating area.
#[derive(Clone, Copy, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum RoomSpec {
    /// At one height.
    #[default]
    Plane(PlaneSpec),
    /// From the bed to the surface.
    Space(SpaceSpec),
}

/// Cells of the plane.
#[derive(Clone, Copy, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PlaneSpec {
    /// Sides along the area's axis and across it, m.
    #[default((Positive::new(1.0), Positive::new(1.0)))]
    pub cell_m: (Positive, Positive),
}

/// Cells of space.
#[derive(Clone, Copy, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SpaceSpec {
    /// Sides along the area's axis, across it and upwards, m.
    #[default((Positive::new(1.0), Positive::new(1.0), Positive::new(1.0)))]
    pub cell_m: (Positive, Positive, Positive),
}

impl RoomSpec {
    /// The cells: whole cells that cover the area; their sides are made a little smaller to fit.
    ///
    /// # Errors
    /// If there would be too many.
    pub(super) fn cells(&self, setting: &Setting) -> Result<BeliefGrid, RobotError> {
        let (counts, _) = self.counts(&setting.area, setting.bed.deepest_m());
        let depth_m = if self.plane() { 1.0 } else { setting.bed.deepest_m() };
        let all: f64 = counts.iter().product();
        // Written so that it also refuses a number that is not finite.
        require(
            all <= MOST_CELLS,
            "strategy.MapAndPlan.room",
            format!("would have {all:.0} cells; at most {MOST_CELLS:.0} are possible: make them larger"),
        )?;
        let n = counts.map(|c| c as usize);
        let cells = BeliefGrid::over(&setting.area, 0.0, depth_m, n);
        let axes = if self.plane() { 2 } else { 3 };
        let (low, high) =
            (cells.cell_m[..axes].iter()).fold((f64::INFINITY, 0.0_f64), |(l, h), c| (c.min(l), c.max(h)));
        require(
            high <= FLATTEST * low,
            "strategy.MapAndPlan.room.cell_m",
            format!("must have sides that differ at most {FLATTEST}-fold, got {} and {} m", shown(low), shown(high)),
        )?;
        Ok(cells)
    }

    /// Number of cells along, across and upwards, and their wanted sides, m.
    pub(super) fn counts(&self, area: &Area, depth_m: f64) -> ([f64; 3], [f64; 3]) {
        let (sides_m, depth_m) = match self {
            RoomSpec::Plane(p) => ([p.cell_m.0, p.cell_m.1, Positive::new(1.0)], 1.0),
            RoomSpec::Space(s) => ([s.cell_m.0, s.cell_m.1, s.cell_m.2], depth_m),
        };
        let sides_m = sides_m.map(Positive::get);
        let extents = [area.length_m, area.width_m, depth_m];
        let counts = [0, 1, 2].map(|a| (extents[a] / sides_m[a] - 1e-9).ceil().max(1.0));
        (counts, sides_m)
    }

    /// Of the plane.
    pub(super) fn plane(&self) -> bool {
        matches!(self, RoomSpec::Plane(_))
    }
}

/// What to do at the target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum AtTarget {
    /// Steer for it again and again, which leads to circles around it (section III-B: the heading is always that to
    /// the target).
    #[default]
    Circle,
    /// Cross the water down-flow of it, from one side to the other.
    Cross(CrossSpec),
}

/// Crossings down-flow of the target.
#[derive(Clone, Copy, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CrossSpec {
    /// Distance down-flow, m.
    #[default(NonNegative::new(5.0))]
    pub down_m: NonNegative,
    /// Distance to either side, m.
    #[default(Positive::new(15.0))]
    pub across_m: Positive,
}
