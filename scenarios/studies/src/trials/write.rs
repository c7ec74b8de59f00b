//! The tables of trials and flights, as CSV.

use super::fly::FlownState;
use super::trial::{SteeringRow, Trial, TrialNumber};
use crate::campaign::report::{Table, TableColumn};
use output::files::csv_text;

/// What the trials found.
pub fn numbers_csv(trials: &[Trial]) -> String {
    let columns: [TableColumn<'_, (&Trial, &TrialNumber)>; 4] = [
        ("trial", &|(trial, _)| trial.name.to_string()),
        ("what", &|(_, found)| found.what.replace(',', ";")),
        ("value", &|(_, found)| found.value.map_or(String::new(), |v| v.to_string())),
        ("unit", &|(_, found)| found.unit.to_string()),
    ];
    Table::of(trials.iter().flat_map(|trial| trial.found.iter().map(move |found| (trial, found))), &columns).csv()
}

/// Heading and rudder over time of the trials by rudder.
pub fn steering_csv(trials: &[Trial]) -> String {
    let columns: [TableColumn<'_, (&Trial, &SteeringRow)>; 7] = [
        ("trial", &|(trial, _)| trial.name.to_string()),
        ("t_s", &|(_, r)| format!("{:.2}", r.t_s)),
        ("ahead_m", &|(_, r)| format!("{:.3}", r.ahead_m)),
        ("starboard_m", &|(_, r)| format!("{:.3}", r.starboard_m)),
        ("heading_deg", &|(_, r)| format!("{:.3}", r.heading_deg)),
        ("rudder_deg", &|(_, r)| format!("{:.3}", r.rudder_deg)),
        ("speed_m_s", &|(_, r)| format!("{:.4}", r.speed_m_s)),
    ];
    Table::of(trials.iter().flat_map(|trial| trial.rows.iter().map(move |row| (trial, row))), &columns).csv()
}

/// The states of a flight; `links` are the names of the drives.
pub fn flown_csv(rows: &[FlownState], links: &[&str]) -> String {
    let own =
        "t_s,east_m,north_m,up_m,q_w,q_x,q_y,q_z,ahead_m_s,left_m_s,up_m_s,roll_rad_s,pitch_down_rad_s,yaw_port_rad_s";
    let columns = [&[own], links].concat().join(",");
    let fields = |row: &FlownState| {
        let (p, q) = (row.truth.pose.p_WB, row.truth.pose.R_WB.quaternion());
        let (v, w) = (row.truth.v_WB_B, row.truth.w_WB_B);
        let state = [row.t_s, p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, w.x, w.y, w.z];
        state.iter().chain(&row.drives).map(f64::to_string).collect::<Vec<_>>()
    };
    csv_text(&columns, rows.iter().map(fields))
}
