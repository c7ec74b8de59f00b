//! The columns of `track.csv`, and the numbers in them.

use crate::columns::{ColumnInfo, columns};
use rheotaxis::frame::RobotFrame;

/// The columns of numbers in the table.
pub const COLUMNS: [ColumnInfo; 19] = columns! {
    "east_m", "m", "True position east of the datum.";
    "north_m", "m", "True position north of the datum.";
    "up_m", "m", "True height above the still surface; negative under water.";
    "roll_deg", "degrees", "True roll, starboard side down positive.";
    "pitch_up_deg", "degrees", "True pitch, nose up positive.";
    "heading_deg", "degrees", "True heading.";
    "est_east_m", "m", "Position east of the datum, as the vehicle believes.";
    "est_north_m", "m", "Position north of the datum, as the vehicle believes.";
    "est_depth_m", "m", "Depth below the surface, as the vehicle believes.";
    "est_roll_deg", "degrees", "Roll, as the vehicle believes.";
    "est_pitch_up_deg", "degrees", "Pitch, nose up positive, as the vehicle believes.";
    "est_heading_deg", "degrees", "Heading, as the vehicle believes.";
    "speed_m_s", "m/s", "True speed over ground, along all three axes together.";
    "altitude_m", "m", "True height above the bed.";
    "reading_v", "V", "Output of the chemical sensor.";
    "reading_ug_l", "ug/L", "Concentration that this output stands for.";
    "detected", "", "Whether the searcher counts the reading as a detection: 1 or 0.";
    "flow_east_m_s", "m/s", "Velocity of the water towards east, as the vehicle believes.";
    "flow_north_m_s", "m/s", "Velocity of the water towards north, as the vehicle believes.";
};

/// The decimals of each.
pub(super) const DECIMALS: [usize; 19] = [3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 3, 4, 4, 0, 4, 4];

const BEFORE: [ColumnInfo; 2] = columns! {
    "t_s", "s", "Time since the start of the mission.";
    "robot", "", "Id of the robot.";
};

/// The last two are there only if a robot has subregions or layers.
const AFTER: [ColumnInfo; 3] = columns! {
    "behaviour", "", "What the robot does: the name of its behaviour.";
    "region", "", "Letter of the subregion that it searches, empty in transits; only if a mission has subregions.";
    "layer", "", "Layer of the planner that controls the vehicle; only if a robot's planner has layers.";
};

/// All columns, in order; the last ones are `numbers` of instruments of other crates.
pub(crate) fn columns(regions: bool, layered: bool, numbers: &[&'static str]) -> Vec<ColumnInfo> {
    let all = BEFORE.into_iter().chain(COLUMNS).chain(AFTER);
    let written = all.filter(|c| (regions || c.name != "region") && (layered || c.name != "layer"));
    let what = "Number that an instrument of another crate gives under this name; its unit is at the end of the name.";
    written.chain(numbers.iter().map(|name| ColumnInfo::new(name, "", what))).collect()
}

/// The numbers of a row, in the order of [`COLUMNS`]; `None` where there is none. `full_scale_ug_l` is the greatest
/// concentration of the chemical sensor, µg/L. The pitch of the true pose is converted to nose-up, as in the estimate.
pub fn numbers(r: &RobotFrame, full_scale_ug_l: Option<f64>) -> [Option<f64>; 19] {
    let (p, e) = (&r.truth.pose, &r.estimate);
    let (roll, pitch_down) = p.roll_pitch();
    let chemical = r.chemical.map(|c| (c.volts, c.of_full_scale));
    let flow = e.flow.map(|f| f.velocity);
    [
        Some(p.p_WB.x),
        Some(p.p_WB.y),
        Some(p.p_WB.z),
        Some(roll.to_degrees()),
        Some(-pitch_down.to_degrees()),
        Some(p.heading().deg()),
        Some(e.position.x),
        Some(e.position.y),
        Some(e.depth_m),
        Some(e.attitude.roll_rad.to_degrees()),
        Some(e.attitude.pitch_rad.to_degrees()),
        Some(e.attitude.heading.deg()),
        Some(r.truth.v_WB_B.norm()),
        Some(r.altitude_m),
        chemical.map(|c| c.0),
        chemical.zip(full_scale_ug_l).map(|(c, f)| c.1 * f),
        Some(f64::from(u8::from(r.detected))),
        flow.map(|v| v.x),
        flow.map(|v| v.y),
    ]
}
