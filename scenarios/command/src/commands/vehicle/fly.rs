//! `rheotaxis vehicle fly`: a vehicle by a table of set-points, as a table of states.

use crate::args::vehicle::VehicleFlyArgs;
use crate::failure::{Failure, hinted};
use crate::say;
use nalgebra::Vector3;
use output::files::write_whole;
use robots::vehicles::Vehicle;
use studies::trials::{Flight, flown_csv, fly, table};
use world::files::read_text;

/// Longest table of set-points, bytes.
const LONGEST: u64 = 64 << 20;

/// Flies it and writes its states.
pub(super) fn flown(args: &VehicleFlyArgs, vehicle: &Vehicle) -> Result<(), Failure> {
    let drives = vehicle.named_drives();
    if drives.is_empty() {
        return Err(hinted(
            "a vehicle without dynamics has no drives to fly it by",
            "a scenario with `strategy: OpenLoop(...)` flies it by a table",
        ));
    }
    for (name, value, legal) in [
        ("--step-s", args.step_s, 1e-4..=0.1),
        ("--every-s", args.every_s, 1e-4..=1e6),
        ("--lasts-s", args.lasts_s, 1e-4..=1e6),
        ("--density", args.density, 900.0..=1300.0),
    ] {
        if !legal.contains(&value) {
            return Err(format!("{name} must be from {} to {}, got {value}", legal.start(), legal.end()).into());
        }
    }
    let text = read_text(&args.table, LONGEST).map_err(|e| format!("{}: {e}", args.table.display()))?;
    let links: Vec<&str> = drives.iter().map(|drive| drive.name.as_str()).collect();
    let set = table(&text, &links).map_err(|e| format!("{}: {e}", args.table.display()))?;
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
    const SHORTER: &str = "give a shorter --step-s, or mend the folder";
    let steady = vehicle.follows(flight.step_s, flight.velocity_m_s.norm());
    steady.map_err(|problem| hinted(problem, SHORTER))?;
    let rows = fly(vehicle, &flight);
    if let Some(lost) = rows.iter().find(|row| !row.truth.is_finite()) {
        let problem = format!(
            "the state at {} s is not a number: steps of {} s are too long for the forces on this hull",
            lost.t_s, flight.step_s
        );
        return Err(hinted(problem, SHORTER));
    }
    write_whole(&args.out, flown_csv(&rows, &links).as_bytes())?;
    say::line(args.out.display());
    Ok(())
}
