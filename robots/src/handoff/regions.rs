//! Parts of the area that a mission searches one after the other.

use serde::Serialize;
use std::sync::Arc;
use world::area::Area;

/// How the search of a subregion stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RegionState {
    /// Its turn has not come.
    #[default]
    Waiting,
    /// Being searched.
    Searching,
    /// Searched to its end, and nothing was declared: free of sources, as far as the mission knows.
    SourceFree,
    /// A source was declared by the strategy that searched it.
    Declared,
    /// The plume was traced to its up-flow edge, and a source declared there.
    UpFlowEdge,
}

impl RegionState {
    /// Name as it stands in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            RegionState::Waiting => "waiting",
            RegionState::Searching => "searching",
            RegionState::SourceFree => "source_free",
            RegionState::Declared => "declared",
            RegionState::UpFlowEdge => "up_flow_edge",
        }
    }
}

/// A subregion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Where it is.
    pub area: Area,
    /// How its search stands.
    pub state: RegionState,
    /// When its search began, s.
    pub from_s: Option<f64>,
    /// When its search ended, s.
    pub until_s: Option<f64>,
}

/// The subregions of a mission, in the order in which they are searched; none where the area is one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regions {
    /// All of them.
    pub all: Arc<[Region]>,
    /// Which one is being searched, from 0; `None` in a transit and after the last.
    pub now: Option<u32>,
}
