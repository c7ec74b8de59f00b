//! What a campaign keeps of a run: a row of the table of runs, and a row for each declaration.

use super::record::{Column, Record, record};
use output::columns::ColumnInfo;
use robots::handoff::{UP_FLOW_EDGE, Verdict};

record! {
    /// What a campaign keeps of a run. Except for the two wall times, it does not depend on the machine, the number of
    /// shards or jobs, or the order.
    RunRow, "runs":
    /// Index of the run in the campaign.
    run: Number "",
    /// Name of the arm.
    arm: Text "",
    /// The conditions of the run, `path=value` joined by `; `, in the campaign's order.
    condition: Text "",
    /// Index of the seed, from 0; equal in two rows that differ only in their arm.
    seed_index: Number "",
    /// The seed of the run.
    seed: Number "",
    /// How the run ended, as in `summary.json` (`found`, `not_found`, ..., `failed`).
    outcome: Text "",
    /// Success as the scenario defines it.
    success: Truth "",
    /// What went wrong in a failed or panicked run.
    error: MaybeText "",
    /// Digest of states, declarations and outcome; empty in a failed run.
    digest: Text "",
    /// Length of the mission.
    mission_s: Real "s",
    /// Time of the first detection by any robot.
    first_detection_s: Maybe "s",
    /// Time of the first declaration by any robot.
    declared_s: Maybe "s",
    /// Position of the first declaration, east.
    declared_east_m: Maybe "m",
    /// Position of the first declaration, north.
    declared_north_m: Maybe "m",
    /// Distance of the first declaration from the nearest true source.
    error_m: Maybe "m",
    /// Part of this error along the flow, down-flow positive.
    error_along_m: Maybe "m",
    /// Part of this error across the flow, right positive looking down-flow.
    error_across_m: Maybe "m",
    /// Number of last detection points on which the first declaration rests, if its rule uses them.
    zone_points: Maybe "",
    /// Time of the oldest of these points.
    zone_since_s: Maybe "s",
    /// Straight distance from the first detection to the declaration.
    traced_m: Maybe "m",
    /// True sources declared within the distance that the scenario's success requires; 0 if it requires none.
    sources_declared: Number "",
    /// Distance travelled by all robots.
    travelled_m: Real "m",
    /// Number of detections by all robots.
    detections: Number "",
    /// Time when a gantry's first sweep ended.
    sweep_s: Maybe "s",
    /// A gantry's speed along its path from the end of its first sweep to its stop.
    speed_m_s: Maybe "m/s",
    /// Net-to-gross displacement ratio of a gantry on that path.
    ngdr: Maybe "",
    /// A gantry's speed in the farther half of the way to the source.
    far_speed_m_s: Maybe "m/s",
    /// A gantry's speed in the nearer half of the way to the source.
    near_speed_m_s: Maybe "m/s",
    /// A gantry's mean distance from the line along the flow through the source, in the farther half.
    far_offset_m: Maybe "m",
    /// A gantry's mean distance from that line in the nearer half.
    near_offset_m: Maybe "m",
    /// Time when a belief's best cell became that of the source and stayed so to the end.
    correct_cell_s: Maybe "s",
    /// Probability that the map of the first robot with a map stated of its best cell, at the robot's first
    /// declaration, or at the end of a run without one.
    map_cell_p: Maybe "",
    /// Probability that this map stated of a source within 5 m of its best cell's centre.
    map_near_p: Maybe "",
    /// Whether the map's best cell held a true source: 1 or 0.
    map_cell_true: MaybeNumber "",
    /// Whether a true source was within 5 m of the best cell's centre: 1 or 0.
    map_near_true: MaybeNumber "",
    /// Whether the robot declared: 1, or 0 if the map is that of the end.
    map_declared: MaybeNumber "",
    /// Wall time of the spin-up; zero if another run of the seed has it, because they shared the spin-up.
    spin_up_wall_s: Real "s",
    /// Wall time of the mission. Of runs in lanes each has its share.
    mission_wall_s: Real "s",
    /// Wall time of the mission's own part, without the water and the plume that runs in lanes share.
    own_wall_s: Maybe "s",
    beside:
    /// All declarations of all robots and gantries, in order of time. They stand in a table of their own.
    declarations: Vec<DeclarationRow>,
}

record! {
    /// A declaration of a run.
    DeclarationRow, "declarations":
    /// Index of the run in the campaign; the next four fields are those of its row, too.
    run: Number "",
    /// Name of the arm.
    arm: Text "",
    /// The conditions of the run.
    condition: Text "",
    /// Index of the seed.
    seed_index: Number "",
    /// The seed of the run.
    seed: Number "",
    /// Id of the robot or gantry that made it.
    robot: Text "",
    /// Number of the declaration among the declarations of this robot, from 0.
    number: Number "",
    /// Subregion in which it was made, from 0.
    region: MaybeNumber "",
    /// Name of the rule that declared it.
    rule: Text "",
    /// The verdict of a look at it: `unchecked`, `verified`, `rejected` or `cannot_tell`.
    verdict: Text "",
    /// Time of the declaration.
    t_s: Real "s",
    /// Position of the declaration, east.
    east_m: Real "m",
    /// Position of the declaration, north.
    north_m: Real "m",
    /// Distance of the declaration from the nearest true source.
    error_m: Maybe "m",
    /// Part of this error along the flow, down-flow positive.
    error_along_m: Maybe "m",
    /// Part of this error across the flow, right positive looking down-flow.
    error_across_m: Maybe "m",
    /// Straight distance to it from the first detection in this area or subregion.
    traced_m: Maybe "m",
    /// The largest shift by a position fix of what the robot believed, in the minute before.
    fix_m: Maybe "m",
}

impl DeclarationRow {
    /// Whether the vehicle has not rejected it.
    pub fn stands(&self) -> bool {
        self.verdict != Verdict::Rejected.name()
    }

    /// Whether it says where a plume crosses a subregion's up-flow edge, not where a source is.
    pub fn at_edge(&self) -> bool {
        self.rule == UP_FLOW_EDGE
    }
}
