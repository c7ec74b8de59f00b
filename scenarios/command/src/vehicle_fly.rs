//! `rheotaxis vehicle fly`: a vehicle by a table of set-points, as a table of states.

use super::args_vehicle::VehicleFlyArgs;
use super::say;
use super::vehicle::{Problem, loaded, plainly};
use nalgebra::Vector3;
use output::files::write_whole;
use robots::vehicles::Vehicle;
use std::fmt::Write as _;
use studies::trials::{Flight, FlownState, fly, table};
use world::files::read_text;

/// Longest table of set-points, bytes.
const LONGEST: u64 = 64 << 20;

/// Flies it and writes its states.
pub(super) fn flown(args: &VehicleFlyArgs) -> Result<(), Problem> {
    let Vehicle::Described(vehicle) = loaded(&args.folder)? else {
        return Err((
            "only a vehicle of a folder has drives with names to fly it by".into(),
            Some("a scenario with `strategy: OpenLoop(...)` flies it by a table".into()),
        ));
    };
    for (name, value, legal) in [
        ("--step-s", args.step_s, 1e-4..=0.1),
        ("--every-s", args.every_s, 1e-4..=1e6),
        ("--lasts-s", args.lasts_s, 1e-4..=1e6),
        ("--density", args.density, 900.0..=1300.0),
    ] {
        if !legal.contains(&value) {
            return Err(plainly(format!("{name} must be from {} to {}, got {value}", legal.start(), legal.end())));
        }
    }
    let text = read_text(&args.table, LONGEST).map_err(|e| plainly(format!("{}: {e}", args.table.display())))?;
    let links: Vec<&str> = vehicle.drives().collect();
    let set = table(&text, &links).map_err(|e| plainly(format!("{}: {e}", args.table.display())))?;
    let [roll, pitch] = args.tilt_deg.0;
    let flight = Flight {
        table: set,
        depth_m: args.depth_m,
        tilt_rad: [roll.to_radians(), pitch.to_radians()],
        velocity_m_s: Vector3::from(args.velocity.0),
        water_m_s: Vector3::from(args.water.0),
        density_kg_m3: args.density,
        step_s: args.step_s,
        every_s: args.every_s,
        lasts_s: args.lasts_s,
    };
    let steady = vehicle.follows(flight.step_s, flight.velocity_m_s.norm());
    let shorter = || Some("give a shorter --step-s, or mend the folder".to_string());
    steady.map_err(|problem| (problem, shorter()))?;
    let rows = fly(&vehicle, &flight);
    if let Some(lost) = rows.iter().find(|row| !row.truth.is_finite()) {
        let problem = format!(
            "the state at {} s is not a number: steps of {} s are too long for the forces on this hull",
            lost.t_s, flight.step_s
        );
        return Err((problem, shorter()));
    }
    write_whole(&args.out, written(&rows, &links).as_bytes()).map_err(plainly)?;
    say::line(args.out.display());
    Ok(())
}

fn written(rows: &[FlownState], links: &[&str]) -> String {
    let mut text = String::from(
        "t_s,east_m,north_m,up_m,q_w,q_x,q_y,q_z,ahead_m_s,left_m_s,up_m_s,roll_rad_s,pitch_down_rad_s,yaw_port_rad_s",
    );
    for link in links {
        write!(text, ",{link}").expect(TEXT);
    }
    text.push('\n');
    for row in rows {
        let (p, q) = (row.truth.pose.p_WB, row.truth.pose.R_WB.quaternion());
        let (v, w) = (row.truth.v_WB_B, row.truth.w_WB_B);
        write!(text, "{}", row.t_s).expect(TEXT);
        let state = [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, w.x, w.y, w.z];
        for number in state.iter().chain(&row.drives) {
            write!(text, ",{number}").expect(TEXT);
        }
        text.push('\n');
    }
    text
}

const TEXT: &str = "writing to a String succeeds";
