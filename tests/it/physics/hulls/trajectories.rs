//! Trajectories integrated elsewhere, within 1 mm and 0.01 degrees over their whole length at steps of 0.02 s.
//!
//! Reference data: `tests/reference/vehicles/README.md`.

use super::kit::{self, built, newtons, shipped, side, still};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use robots::vehicles::{DriveSpec, Vehicle};
use world::frames::{Pose, Truth};

const DT_S: f64 = 0.02;

/// Rows of t, position (NED), quaternion, velocities.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let of = |line: &str| line.split(',').map(|n| n.parse().expect("a number")).collect();
    text.lines().skip(1).map(of).collect()
}

/// Place and attitude of a row, in ENU and FLU.
fn pose(row: &[f64]) -> Pose {
    let ned = UnitQuaternion::new_normalize(Quaternion::new(row[4], row[5], row[6], row[7]));
    // FLU to FRD, FRD to NED, NED to ENU.
    let half_turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let to_enu = UnitQuaternion::from_quaternion(Quaternion::new(0.0, 1.0, 1.0, 0.0));
    Pose { p_WB: Vector3::new(row[2], row[1], -row[3]), R_WB: to_enu * ned * half_turn }
}

/// Flies a vehicle from the first row, with set-points by time; greatest distance (m) and angle (degrees).
fn apart(vehicle: &mut Vehicle, text: &str, set: impl Fn(f64) -> Vec<f64>) -> (f64, f64) {
    let rows = rows(text);
    let first = &rows[0];
    let mut truth = Truth::at_rest(pose(first));
    truth.v_WB_B = Vector3::new(first[8], -first[9], -first[10]);
    truth.w_WB_B = Vector3::new(first[11], -first[12], -first[13]);
    let (mut metres, mut degrees) = (0.0f64, 0.0f64);
    let mut step = 0u32;
    for row in &rows[1..] {
        while f64::from(step) * DT_S < row[0] - 0.5 * DT_S {
            let command = kit::set(&set(f64::from(step) * DT_S));
            truth = vehicle.step_in(&truth, &still(1025.0), &command, DT_S);
            step += 1;
        }
        let there = pose(row);
        metres = metres.max((truth.pose.p_WB - there.p_WB).norm());
        degrees = degrees.max(truth.pose.R_WB.angle_to(&there.R_WB).to_degrees());
    }
    (metres, degrees)
}

fn bluerov() -> Vehicle {
    let (mut file, urdf) = shipped("bluerov2_heavy");
    for drive in &mut file.drives {
        let DriveSpec::Thruster(thruster) = drive else {
            panic!("a BlueROV has thrusters only");
        };
        *drive = newtons(&thruster.link);
    }
    built(&file, &urdf)
}

/// The hull alone, with a thruster along its axis and two beside it.
fn lauv() -> Vehicle {
    let (mut file, urdf) = shipped("lauv");
    let three = side("push", 0.0) + &side("port", 0.5) + &side("starboard", -0.5);
    let urdf = urdf.replace("</robot>", &format!("{three}</robot>"));
    let fins = file.drives.clone();
    file.drives = ["push", "port", "starboard"].map(newtons).to_vec();
    // Its autopilot needs fins: they are there, as small as can be.
    for drive in fins {
        if let DriveSpec::Fin(mut fin) = drive {
            fin.area_m2 = world::ranges::Positive::new(1e-10);
            fin.drag_0 = world::ranges::NonNegative::new(0.0);
            file.drives.push(DriveSpec::Fin(fin));
        }
    }
    built(&file, &urdf)
}

macro_rules! reference {
    ($file:literal) => {
        include_str!(concat!("../../../reference/vehicles/", $file, ".csv"))
    };
}

fn near((metres, degrees): (f64, f64)) {
    assert!(metres < 1e-3, "{metres} m");
    assert!(degrees < 0.01, "{degrees} degrees");
}

#[test]
fn a_bluerov_pitches_as_it_surges() {
    let set = vec![2.5, 2.5, -2.5, -2.5, 0.0, 0.0, 0.0, 0.0];
    near(apart(&mut bluerov(), reference!("bluerov2_surge_step"), |_| set.clone()));
}

#[test]
fn a_bluerov_turns_and_sinks() {
    let set = vec![-3.0, 3.0, 3.0, -3.0, -6.0, 6.0, 6.0, -6.0];
    near(apart(&mut bluerov(), reference!("bluerov2_yaw_heave"), |_| set.clone()));
}

#[test]
fn a_lauv_coasts_and_turns() {
    let mut vehicle = lauv();
    let n = vehicle.states().len();
    near(apart(&mut vehicle, reference!("lauv_coast_turn"), |t_s| {
        // FRD: to starboard is positive, so the port one pushes ahead.
        let turn = if (5.0 - 1e-9..15.0 - 1e-9).contains(&t_s) { 1.5 } else { 0.0 };
        let mut set = vec![0.0; n];
        (set[0], set[1], set[2]) = (8.0, turn, -turn);
        set
    }));
}

#[test]
fn a_lauv_released_heeled_swings() {
    let mut vehicle = lauv();
    let n = vehicle.states().len();
    near(apart(&mut vehicle, reference!("lauv_heel_release"), |_| vec![0.0; n]));
}
