//! Parts of the area that a mission searches one after the other.

use serde::Serialize;
use strum::IntoStaticStr;
use world::area::Area;

/// How the search of a subregion stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum RegionState {
    /// Its turn has not come.
    #[default]
    Waiting,
    /// Being searched.
    Searching,
    /// The strategy that searched it ended without a declaration: free of sources, as far as the mission knows.
    SourceFree,
    /// The time for its search ran out without a declaration: it may still hold a source.
    TimedOut,
    /// A source was declared by the strategy that searched it.
    Declared,
    /// The plume was traced to the up-flow edge, and a source was declared there.
    UpFlowEdge,
}

impl RegionState {
    /// Name as it stands in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The same, for reports.
    pub fn label(self) -> &'static str {
        match self {
            RegionState::Waiting => "not searched",
            RegionState::Searching => "search not ended",
            RegionState::SourceFree => "source free",
            RegionState::TimedOut => "timed out",
            RegionState::Declared => "source declared",
            RegionState::UpFlowEdge => "plume to up-flow edge",
        }
    }
}

/// Name of the `k`-th subregion, from 0, in the order of search: A to Z, then AA, AB and so on. It is made of letters
/// so that nobody takes it for the number of a declared source.
pub fn region_name(k: u32) -> String {
    let letter = char::from(b'A' + (k % 26) as u8);
    match k / 26 {
        0 => letter.to_string(),
        more => region_name(more - 1) + &letter.to_string(),
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

/// The subregions of a mission in the order of search; empty if the mission has none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regions {
    /// All of them.
    pub all: Vec<Region>,
    /// The one being searched, from 0; `None` in transit and after the last.
    pub now: Option<u32>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_have_letters() {
        assert_eq!([0, 3, 25, 26, 51, 52, 701, 702].map(region_name), ["A", "D", "Z", "AA", "AZ", "BA", "ZZ", "AAA"]);
    }
}
