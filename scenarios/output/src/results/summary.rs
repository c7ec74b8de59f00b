//! What `summary.json` says about a run.

use super::{DeclarationSummary, GantrySummary, MapEnd, MapStated, Position};
use rheotaxis::incidents::{Incident, IncidentKind};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::VERSION;
use rheotaxis::score::Consultations;
use robots::handoff::RegionState;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// A true source.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SourceSummary {
    /// Its id in the scenario.
    pub id: String,
    /// Its position.
    pub position: Position,
    /// Its depth below the still surface, m.
    pub depth_m: f64,
    /// Where the mean flow at the source goes, degrees from north; `None` in still water.
    pub flow_heading_deg: Option<f64>,
}

/// A subregion at the end of the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RegionSummary {
    /// Its name: a letter, in the order of search.
    pub name: String,
    /// Its centre.
    pub centre: Position,
    /// The state of its search.
    pub state: RegionState,
    /// When its search began, s.
    pub from_s: Option<f64>,
    /// When its search ended, s.
    pub until_s: Option<f64>,
}

/// What a robot took from its battery.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EnergySummary {
    /// Energy of the full battery, Wh.
    pub battery_wh: f64,
    /// Used by the drives, Wh.
    pub drives_wh: f64,
    /// Used by the hotel load, Wh.
    pub hotel_wh: f64,
    /// How long a full battery lasts at the mean power of the mission, s; `None` if no power was used.
    pub endurance_s: Option<f64>,
    /// When the battery was empty, s.
    pub emptied_s: Option<f64>,
}

/// The results of one robot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobotSummary {
    /// Its id in the scenario.
    pub id: String,
    /// Its declarations, in order of their numbers.
    pub declarations: Vec<DeclarationSummary>,
    /// Number of declarations that are sources.
    pub sources_declared: usize,
    /// Number of plumes that were traced to the up-flow edge of a subregion.
    pub up_flow_edges: usize,
    /// The subregions of its mission, in the order of their search; empty if the area is not divided.
    pub regions: Vec<RegionSummary>,
    /// Number of subregions whose time ran out.
    pub regions_timed_out: usize,
    /// Time of the first detection, s.
    pub first_detection_s: Option<f64>,
    /// True position at that time.
    pub first_detection: Option<Position>,
    /// Readings with a detection.
    pub detections: u64,
    /// Straight distance from the first detection to the first declaration, m: how far it traced the plume.
    pub traced_m: Option<f64>,
    /// When the most probable cell of its map became that of a true source and stayed so to the end, s.
    pub correct_cell_s: Option<f64>,
    /// The final state of its map; `None` for a robot without a map.
    pub map: Option<MapEnd>,
    /// How sure the map was at the first declaration, or at the end without one, and whether that was true.
    pub map_stated: Option<MapStated>,
    /// Length of the true path, m.
    pub travelled_m: f64,
    /// Distance between believed and true position at the end, m.
    pub final_position_error_m: f64,
    /// Greatest distance between believed and true position, m.
    pub greatest_position_error_m: f64,
    /// What it took from its battery; `None` if the scenario gives it none.
    pub energy: Option<EnergySummary>,
    /// How often it asked a searcher outside the program; `None` if it never did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub consulted: Option<Consultations>,
    /// Share of the time with a thruster at its limit; `None` of a vehicle whose autopilot shares out no forces among
    /// thrusters.
    pub saturated: Option<f64>,
    /// Last numbers of its instruments of other crates, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub last_numbers: BTreeMap<&'static str, f64>,
    /// Behaviour at the end.
    pub last_behaviour: String,
    /// Time spent in each behaviour, s, in the order of first use.
    pub behaviour_s: Vec<(String, f64)>,
}

/// Something that went wrong without ending the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AbnormalSummary {
    /// The robot's id in the scenario.
    pub robot: String,
    /// The kind of event.
    pub what: IncidentKind,
    /// What failed and how, if it is a fault of the scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<String>,
    /// Beginning, s of mission time.
    pub t_s: f64,
    /// Duration, s.
    pub lasted_s: f64,
    /// Whether it ended before the run.
    pub over: bool,
    /// Position at its beginning.
    pub position: Position,
    /// Depth below the still surface, m.
    pub depth_m: f64,
    /// The whole event in one line, for people.
    pub line: String,
}

impl From<&Incident> for AbnormalSummary {
    fn from(a: &Incident) -> Self {
        Self {
            robot: a.robot.clone(),
            what: a.what,
            fault: a.fault.clone(),
            t_s: a.t_s,
            lasted_s: a.lasted_s,
            over: a.over,
            position: a.p_W.xy().into(),
            depth_m: -a.p_W.z,
            line: a.line(),
        }
    }
}

/// Chemical released and where it went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MassBalance {
    /// Released, kg.
    pub released_kg: f64,
    /// Still in the simulated water, kg.
    pub in_water_kg: f64,
    /// Carried out of the simulated water, kg.
    pub left_kg: f64,
    /// Released − in the water − carried out, kg: only rounding.
    pub imbalance_kg: f64,
}

impl MassBalance {
    /// From its three terms.
    pub fn new(released_kg: f64, in_water_kg: f64, left_kg: f64) -> Self {
        Self { released_kg, in_water_kg, left_kg, imbalance_kg: released_kg - in_water_kg - left_kg }
    }
}

/// Counts and times of the run itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Totals {
    /// Simulated time of the mission, s.
    pub mission_s: f64,
    /// Simulated time of the plume before the mission, s.
    pub spin_up_s: f64,
    /// Wall time of the mission, s.
    pub mission_wall_s: f64,
    /// Wall time of the spin-up, s.
    pub spin_up_wall_s: f64,
    /// Whether the spin-up was taken from the cache; its wall time is then that of reading it.
    pub spin_up_kept: bool,
    /// Steps of the mission.
    pub steps: u64,
    /// Filaments at the end.
    pub filaments: usize,
    /// Where the chemical went; `None` without a source.
    pub mass: Option<MassBalance>,
}

/// [`Totals`] with the resulting speeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RunSummary {
    /// Counts and times.
    #[serde(flatten)]
    pub totals: Totals,
    /// Simulated time divided by wall time, mission only.
    pub real_time_factor: Option<f64>,
    /// Simulated mission time divided by all wall time, including the spin-up: what a user waits for.
    pub real_time_factor_with_spin_up: Option<f64>,
}

/// Version of rapier3d in the program. It moves the joints of gantries, which are part of the digest.
const RAPIER: &str = "0.36.1";

/// The versions that made a run: equal digests are promised for equal versions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Versions {
    /// Version of the program.
    pub rheotaxis: String,
    /// Version of the format of scenario files.
    pub scenario: u32,
    /// Version of the rigid-body solver.
    pub rapier3d: &'static str,
}

impl Versions {
    pub(crate) fn with_version(rheotaxis: &str) -> Self {
        Self { rheotaxis: rheotaxis.to_string(), scenario: VERSION, rapier3d: RAPIER }
    }
}

/// The results of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the scenario.
    pub scenario: String,
    /// Its title.
    pub title: String,
    /// The scenario's rule of success, in words.
    pub success_rule: String,
    /// Seed.
    pub seed: u64,
    /// The mark of the secret key that the run had beside its seed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// The versions that made the run.
    pub versions: Versions,
    /// Digest of all states, declarations and the outcome; the same run has the same digest.
    pub digest: String,
    /// How it ended.
    pub outcome: RunOutcome,
    /// The error that ended it.
    pub error: Option<String>,
    /// The true sources.
    pub sources: Vec<SourceSummary>,
    /// Each robot.
    pub robots: Vec<RobotSummary>,
    /// Each gantry.
    pub gantries: Vec<GantrySummary>,
    /// Machines of other crates that have their own part here, by id.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub apparatus: BTreeMap<String, Value>,
    /// The last value of each topic of another crate, by key.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub published: BTreeMap<String, Value>,
    /// Events that went wrong without ending the run.
    pub abnormal: Vec<AbnormalSummary>,
    /// The run itself.
    pub run: RunSummary,
}

impl Summary {
    /// As JSON for people.
    pub fn json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("plain data becomes JSON");
        text.push('\n');
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solver_is_the_one_that_is_built_in() {
        let lock = include_str!("../../../../Cargo.lock");
        let entry = format!("name = \"rapier3d-f64\"\nversion = \"{RAPIER}\"\n");
        assert!(lock.contains(&entry), "Cargo.lock has another rapier3d");
    }
}
