//! Flies a vehicle by a table of set-points: what a tank or another simulator is compared with.
//!
//! *Source*: open-loop vehicle trials (Prestero 2001, chapter 6).
//!
//! *Parameters*: [`Flight`].
//!
//! *Deviations*: no autopilot, no instruments, no bed; uniform water.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use robots::vehicles::Vehicle;
use world::fields::WaterSample;
use world::frames::{Pose, Truth};

/// How a vehicle is flown.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight {
    /// Times (s) and set-points of all drives; each holds until the next.
    pub table: Vec<(f64, Vec<f64>)>,
    /// Depth at the start, m, at which its nose is to the north.
    pub depth_m: f64,
    /// Roll (right side down) and pitch (nose up) at the start, rad.
    pub tilt_rad: [f64; 2],
    /// Velocity through the water at the start (ahead, left, up), m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Velocity of the water (east, north, up), m/s.
    pub water_m_s: Vector3<f64>,
    /// Density of the water, kg/m³.
    pub density_kg_m3: f64,
    /// Step, s, and time from row to row, s.
    pub step_s: f64,
    /// Time from row to row, s.
    pub every_s: f64,
    /// When it ends, s.
    pub lasts_s: f64,
}

/// A state on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct FlownState {
    /// Time, s.
    pub t_s: f64,
    /// True state.
    pub truth: Truth,
    /// State of each drive.
    pub drives: Vec<f64>,
}

/// Reads a table: a column `t_s`, and one column for each drive, by the name of its link.
///
/// # Errors
/// What is wrong, with its line.
pub fn table(text: &str, drives: &[&str]) -> Result<Vec<(f64, Vec<f64>)>, String> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let header = reader.headers().map_err(|e| e.to_string())?.clone();
    let column = |name: &str| {
        (header.iter().position(|h| h == name))
            .ok_or_else(|| format!("line 1: no column \"{name}\"; needed are t_s, {}", drives.join(", ")))
    };
    let columns: Vec<usize> =
        std::iter::once("t_s").chain(drives.iter().copied()).map(column).collect::<Result<_, _>>()?;
    if let Some(odd) = header.iter().find(|h| *h != "t_s" && !drives.contains(h)) {
        return Err(format!("line 1: the vehicle has no drive \"{odd}\"; it has {}", drives.join(", ")));
    }
    let mut rows: Vec<(f64, Vec<f64>)> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| e.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let numbers = columns.iter().map(|k| {
            let cell = &record[*k];
            let number = cell.parse::<f64>().ok().filter(|v| v.is_finite());
            number.ok_or_else(|| format!("line {line}, {}: not a number: \"{cell}\"", &header[*k]))
        });
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
        if rows.last().is_some_and(|(t_s, _)| numbers[0] <= *t_s) {
            return Err(format!("line {line}, t_s: times must rise"));
        }
        rows.push((numbers[0], numbers[1..].to_vec()));
    }
    if rows.is_empty() {
        return Err("there is no row of set-points".into());
    }
    Ok(rows)
}

/// The states at the beginning, at the end, and at whole multiples of `every_s`.
pub fn fly(vehicle: &Vehicle, flight: &Flight) -> Vec<FlownState> {
    let mut vehicle = vehicle.clone();
    let [roll, pitch_up] = flight.tilt_rad;
    let R_WB = UnitQuaternion::from_euler_angles(roll, -pitch_up, std::f64::consts::FRAC_PI_2);
    let mut truth = Truth::at_rest(Pose { p_WB: Vector3::new(0.0, 0.0, -flight.depth_m), R_WB });
    truth.v_WB_B = flight.velocity_m_s + R_WB.inverse() * flight.water_m_s;
    let water = WaterSample {
        velocity: flight.water_m_s,
        gradient: Matrix3::zeros(),
        rate: Vector3::zeros(),
        density_kg_m3: flight.density_kg_m3,
    };
    let idle = vehicle.idle();
    let mut rows = Vec::new();
    let steps = (flight.lasts_s / flight.step_s).round() as u64;
    let stride = ((flight.every_s / flight.step_s).round() as u64).max(1);
    for k in 0..=steps {
        let t_s = k as f64 * flight.step_s;
        if k % stride == 0 || k == steps {
            rows.push(FlownState { t_s, truth, drives: vehicle.states() });
        }
        // Half a step of slack: times of the table are multiples of the step but for rounding.
        let row = (flight.table).partition_point(|(from_s, _)| *from_s <= t_s + 1e-6 * flight.step_s);
        let asked = flight.table[..row].last().map_or(&[][..], |(_, asked)| asked);
        let set = asked.iter().enumerate().fold(idle, |set, (k, value)| set.with_drive(k, *value));
        truth = vehicle.step_in(&truth, &water, &set, flight.step_s);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_or_refused_with_their_line() {
        let drives = ["left", "right"];
        let good = table("t_s, right, left\n0, 1, 2\n5, 3, 4\n", &drives);
        assert_eq!(good, Ok(vec![(0.0, vec![2.0, 1.0]), (5.0, vec![4.0, 3.0])]));
        for (text, why) in [
            ("t_s,left\n0,1\n", "no column \"right\""),
            ("t_s,left,right,up\n0,1,2,3\n", "no drive \"up\""),
            ("t_s,left,right\n0,1,x\n", "line 2, right: not a number"),
            ("t_s,left,right\n0,1,NaN\n", "line 2, right: not a number"),
            ("t_s,left,right\n1,1,1\n1,1,1\n", "line 3, t_s: times must rise"),
            ("t_s,left,right\n", "no row"),
            ("t_s,left,right\n0,1\n", "line: 2"),
        ] {
            let said = table(text, &drives).expect_err("wrong");
            assert!(said.contains(why), "{said}");
        }
    }
}
