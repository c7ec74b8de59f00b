//! One run of a campaign as a row of its table.

/// What a campaign keeps of a run. Everything but the two wall times is the same on any machine,
/// shard count, number of jobs and order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunRow {
    /// Index of the run in the campaign.
    pub run: u64,
    /// Name of the arm.
    pub arm: String,
    /// The conditions drawn or laid out for it, `path=value` joined by `; `, in the campaign's order.
    pub condition: String,
    /// Which of the seeds, from 0: equal in two rows that differ only in their arm.
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
    /// Where it was (east, north), m.
    pub declared_east_m: Option<f64>,
    /// Where it was (east, north), m.
    pub declared_north_m: Option<f64>,
    /// Its distance from the nearest true source, m.
    pub error_m: Option<f64>,
    /// Part of it along the flow, down-flow positive, m.
    pub error_along_m: Option<f64>,
    /// Part of it across the flow, right positive looking down-flow, m.
    pub error_across_m: Option<f64>,
    /// Last detection points it rests on, where its rule is one on them.
    pub zone_points: Option<f64>,
    /// Time of the oldest of them, s.
    pub zone_since_s: Option<f64>,
    /// Straight way from the first detection to the declaration, m.
    pub traced_m: Option<f64>,
    /// Way travelled by all robots, m.
    pub travelled_m: f64,
    /// Detections by all robots.
    pub detections: u64,
    /// When a gantry's first sweep was over, s.
    pub sweep_s: Option<f64>,
    /// A gantry's speed along its path from there to its stop, m/s.
    pub speed_m_s: Option<f64>,
    /// Its net-to-gross displacement ratio on that path.
    pub ngdr: Option<f64>,
    /// Its speed in the farther half of the way to the source, m/s.
    pub far_speed_m_s: Option<f64>,
    /// Its speed in the nearer half, m/s.
    pub near_speed_m_s: Option<f64>,
    /// Its mean distance from the source's line along the flow in the farther half, m.
    pub far_offset_m: Option<f64>,
    /// The same in the nearer half, m.
    pub near_offset_m: Option<f64>,
    /// When a belief's best cell came to be the source's and stayed so to the end, s.
    pub correct_cell_s: Option<f64>,
    /// Wall time of the spin-up, s; zero where it was taken over from another run.
    pub spin_up_wall_s: f64,
    /// Wall time of the mission, s.
    pub mission_wall_s: f64,
}
