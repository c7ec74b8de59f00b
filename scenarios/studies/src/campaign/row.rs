//! What a campaign keeps of a run: a row of the table of runs, and a row for each declaration.

use robots::handoff::{UP_FLOW_EDGE, Verdict};

/// What a campaign keeps of a run. Except for the two wall times, it does not depend on the machine, the number of
/// shards or jobs, or the order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunRow {
    /// Index of the run in the campaign.
    pub run: u64,
    /// Name of the arm.
    pub arm: String,
    /// The conditions of the run, `path=value` joined by `; `, in the campaign's order.
    pub condition: String,
    /// Index of the seed, from 0. It is equal in two rows that differ only in their arm.
    pub seed_index: u64,
    /// The seed itself.
    pub seed: u64,
    /// How the run ended, as in `summary.json` (`found`, `not_found`, ..., `failed`).
    pub outcome: String,
    /// Success as the scenario defines it.
    pub success: bool,
    /// What went wrong in a failed or panicked run.
    pub error: Option<String>,
    /// Digest of the state sequence; empty in a failed run.
    pub digest: String,
    /// Length of the mission, s.
    pub mission_s: f64,
    /// First detection by any robot, s.
    pub first_detection_s: Option<f64>,
    /// First declaration by any robot, s.
    pub declared_s: Option<f64>,
    /// Its position east, m.
    pub declared_east_m: Option<f64>,
    /// Its position north, m.
    pub declared_north_m: Option<f64>,
    /// Its distance from the nearest true source, m.
    pub error_m: Option<f64>,
    /// Part of it along the flow, down-flow positive, m.
    pub error_along_m: Option<f64>,
    /// Part of it across the flow, right positive looking down-flow, m.
    pub error_across_m: Option<f64>,
    /// Number of last detection points on which it rests, if its rule uses them.
    pub zone_points: Option<f64>,
    /// Time of the oldest of them, s.
    pub zone_since_s: Option<f64>,
    /// Straight distance from the first detection to the declaration, m.
    pub traced_m: Option<f64>,
    /// All declarations of all robots and gantries, in order of time. They stand in a table of their own.
    pub declarations: Vec<DeclarationRow>,
    /// True sources declared within the distance that the scenario's success requires; 0 if it requires none.
    pub sources_declared: u64,
    /// Distance travelled by all robots, m.
    pub travelled_m: f64,
    /// Number of detections by all robots.
    pub detections: u64,
    /// End of a gantry's first sweep, s.
    pub sweep_s: Option<f64>,
    /// A gantry's speed along its path from there to its stop, m/s.
    pub speed_m_s: Option<f64>,
    /// Its net-to-gross displacement ratio on that path.
    pub ngdr: Option<f64>,
    /// Its speed in the farther half of the way to the source, m/s.
    pub far_speed_m_s: Option<f64>,
    /// Its speed in the nearer half, m/s.
    pub near_speed_m_s: Option<f64>,
    /// Its mean distance from the line along the flow through the source, in the farther half, m.
    pub far_offset_m: Option<f64>,
    /// Its mean distance from that line in the nearer half, m.
    pub near_offset_m: Option<f64>,
    /// When a belief's best cell became that of the source and stayed so to the end, s.
    pub correct_cell_s: Option<f64>,
    /// Probability that the map of the first robot with a map stated of its best cell, at the robot's first
    /// declaration, or at the end of a run without one.
    pub map_cell_p: Option<f64>,
    /// Probability that it stated of a source within 5 m of that cell's centre.
    pub map_near_p: Option<f64>,
    /// Whether the cell held a true source: 1 or 0.
    pub map_cell_true: Option<u64>,
    /// Whether a true source was within 5 m of its centre: 1 or 0.
    pub map_near_true: Option<u64>,
    /// Whether the robot declared: 1, or 0 if the map is that of the end.
    pub map_declared: Option<u64>,
    /// Wall time of the spin-up, s; zero if another run of the seed has it, because they shared the spin-up.
    pub spin_up_wall_s: f64,
    /// Wall time of the mission, s. Of runs in lanes each has its share.
    pub mission_wall_s: f64,
}

/// A declaration of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeclarationRow {
    /// Index of the run in the campaign; the next four fields are those of its row, too.
    pub run: u64,
    /// Name of the arm.
    pub arm: String,
    /// The conditions of the run.
    pub condition: String,
    /// Index of the seed.
    pub seed_index: u64,
    /// The seed itself.
    pub seed: u64,
    /// Id of the robot or gantry that made it.
    pub robot: String,
    /// Its number among the declarations of this robot, from 0.
    pub number: u64,
    /// Subregion in which it was made, from 0.
    pub region: Option<u64>,
    /// Name of the rule that declared it.
    pub rule: String,
    /// The verdict of a look at it: `unchecked`, `verified`, `rejected` or `cannot_tell`.
    pub verdict: String,
    /// Time, s.
    pub t_s: f64,
    /// Position east, m.
    pub east_m: f64,
    /// Position north, m.
    pub north_m: f64,
    /// Its distance from the nearest true source, m.
    pub error_m: Option<f64>,
    /// Part of it along the flow, down-flow positive, m.
    pub error_along_m: Option<f64>,
    /// Part of it across the flow, right positive looking down-flow, m.
    pub error_across_m: Option<f64>,
    /// Straight distance to it from the first detection in this area or subregion, m.
    pub traced_m: Option<f64>,
    /// The largest shift by a position fix of what the robot believed, in the minute before, m.
    pub fix_m: Option<f64>,
}

impl DeclarationRow {
    /// Whether the vehicle has not rejected it.
    #[must_use]
    pub fn stands(&self) -> bool {
        self.verdict != Verdict::Rejected.name()
    }

    /// Whether it says where a plume crosses a subregion's up-flow edge, not where a source is.
    #[must_use]
    pub fn at_edge(&self) -> bool {
        self.rule == UP_FLOW_EDGE
    }
}
