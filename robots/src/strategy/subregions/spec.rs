//! Parameters of a mission over subregions.

use super::super::catalogue::StrategySpec;
use super::super::setting::Setting;
use super::super::spec::{Strategy, StrategyParams};
use super::super::wishes::VerticalSpec;
use super::super::wishes::Wishes;
use super::machine::Subregions;
use crate::error::RobotError;
use crate::handoff::Need;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroU32;
use world::area::Area;
use world::catalogue;
use world::cost::{Cost, Times};
use world::ranges::{Finite, NonNegative, Positive};
use world::registry::Listed;

/// The subregions, the strategy that searches them, and when a search is over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SubregionsSpec {
    /// The subregions' places, in the order of search.
    pub regions: RegionsSpec,
    /// The strategy that searches each of them; it starts afresh in each.
    pub search: StrategySpec,
    /// A search without a declaration is given up after this time, s.
    pub timeout_s: Positive,
    /// Where a search begins.
    #[serde(default)]
    pub entry: Entry,
    /// When a plume counts as traced to the up-flow edge.
    #[serde(default)]
    pub edge: EdgeSpec,
    /// Speed over ground in transits and on the way home, m/s (section 6: 2).
    #[serde(default = "speed")]
    pub speed_m_s: Positive,
    /// Altitude or depth in transits and on the way home (section 6: 1.5 m above the bed in the mission of several
    /// sources).
    #[serde(default = "vertical")]
    pub vertical: VerticalSpec,
}

fn speed() -> Positive {
    Positive::new(2.0)
}

fn vertical() -> VerticalSpec {
    VerticalSpec::Altitude(Positive::new(1.5))
}

impl Listed for SubregionsSpec {
    const ENTRY: catalogue::Entry = catalogue::Entry {
        name: "Subregions",
        what: "searches one subregion after the other, until a declaration, a plume traced to the up-flow edge, or a \
            time-out",
        source: "Pang 2009, section 6",
    };
}

impl StrategyParams for SubregionsSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(Subregions::new(self, setting)?))
    }

    fn check(&self, setting: &Setting) -> Result<(), RobotError> {
        self.search.check(setting)
    }

    fn needs(&self) -> Vec<Need> {
        let needs = self.search.needs().into_iter();
        needs.map(|n| n.within("search")).collect()
    }

    fn wishes(&self) -> Wishes {
        let mut wishes = Wishes::mission(self.speed_m_s, self.vertical);
        let search = self.search.wishes().within("search");
        wishes.verticals.extend(search.verticals);
        wishes.speeds_m_s.extend(search.speeds_m_s);
        wishes.waits.extend(search.waits);
        wishes
    }

    fn declares_at_most(&self) -> usize {
        let regions = match &self.regions {
            RegionsSpec::Grid(grid) => grid.order.len(),
            RegionsSpec::Rectangles(rectangles) => rectangles.list.len(),
        };
        regions * self.search.declares_at_most()
    }

    fn has_regions(&self) -> bool {
        true
    }

    fn cost(&self, area: &Area, depth_m: f64, obstacles: usize, times: &Times) -> Cost {
        (self.search.cost(area, depth_m, obstacles, times)).under("search")
    }
}

/// Where the subregions are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum RegionsSpec {
    /// The operating area divided evenly.
    Grid(GridSpec),
    /// Rectangles along the operating area's axes.
    Rectangles(RectanglesSpec),
}

/// An even division of the operating area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "SubregionsGridSpec")]
#[serde(deny_unknown_fields)]
pub struct GridSpec {
    /// Parts along the area's axis.
    pub along: NonZeroU32,
    /// Parts across the axis.
    pub across: NonZeroU32,
    /// (along, across) of each part to be searched, in this order, counted from 0 at the area's rear left corner,
    /// looking along its axis. Other parts are not searched.
    pub order: Vec<(u32, u32)>,
}

/// A list of rectangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectanglesSpec {
    /// The rectangles, in the order of search.
    pub list: Vec<RectangleSpec>,
}

/// A rectangle along the operating area's axes, within the area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleSpec {
    /// From and to along the area's axis, m from the area's centre.
    pub along_m: (Finite, Finite),
    /// From and to across the axis, m from the centre, positive to the right, looking along the axis.
    pub across_m: (Finite, Finite),
}

/// Where the search of a subregion begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "SubregionEntry")]
pub enum Entry {
    /// In its most down-flow corner (section 5.2).
    #[default]
    DownFlowCorner,
    /// In its middle.
    Centre,
}

/// When a plume counts as traced to the up-flow edge.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EdgeSpec {
    /// A detection nearer to the edge than this, or beyond the edge, has reached it, m.
    #[default(NonNegative::new(20.0))]
    pub within_m: NonNegative,
    /// The plume's place is the mean of the detections of this time, s.
    #[default(NonNegative::new(10.0))]
    pub plume_s: NonNegative,
}
