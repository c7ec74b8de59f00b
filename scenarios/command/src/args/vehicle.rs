//! Arguments of `rheotaxis vehicle`.

use super::values::Numbers;
use clap::Subcommand;
use std::path::PathBuf;

/// Help of `vehicle`.
pub(super) const VEHICLE_ABOUT: &str = "\
Check a vehicle of your own and put it through trials.

A vehicle is a folder with `vehicle.ron` (what the water does to the hull, its drives, its autopilot) and a URDF (links, \
shapes, mass, and where drives and instruments sit). A scenario uses it with `vehicle: File(\"my_auv/\")`; those that come \
with the program with `vehicle: Shipped(\"lauv\")`. `rheotaxis vehicle init lauv my_auv/` writes a copy to change.";

const AFTER: &str = "\
Examples:
  rheotaxis list vehicles                   what comes with the program, and what each can do
  rheotaxis vehicle init bluerov2 my_auv    write a copy of a shipped vehicle to change
  rheotaxis vehicle check my_auv            what is wrong or doubtful, and a drawing with its forces
  rheotaxis vehicle trials my_auv           speed, turning circle, zigzags, dive, stop, station keeping

Exit codes: 0 fine, or only doubts; 1 error; 2 wrong usage.";

/// Arguments of `vehicle`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = AFTER)]
pub struct VehicleArgs {
    /// What to do.
    #[command(subcommand)]
    pub command: VehicleCommand,
}

/// What to do with a vehicle.
#[derive(Clone, Debug, PartialEq, Subcommand)]
pub enum VehicleCommand {
    /// Say what is wrong or doubtful about a vehicle, and draw its hull with its forces.
    Check(VehicleCheckArgs),
    /// Run its trials in open water: a table and a figure.
    Trials(VehicleTrialsArgs),
    /// Fly it by a table of set-points, to compare it with a tank or another simulator.
    Fly(VehicleFlyArgs),
    /// Write a copy of a shipped vehicle to start from.
    Init(VehicleInitArgs),
}

/// Arguments of `vehicle check`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct VehicleCheckArgs {
    /// Folder of the vehicle, or a name that `rheotaxis list vehicles` prints.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Where to draw it, as SVG or PNG by its ending [default: FOLDER.svg in the present folder].
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Arguments of `vehicle trials`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct VehicleTrialsArgs {
    /// Folder of the vehicle, or a name that `rheotaxis list vehicles` prints.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Folder for `trials.csv`, `trials.svg`, `trials.png` and, of a vehicle with a rudder, `steering.csv`.
    #[arg(long, value_name = "DIR", default_value = "trials")]
    pub out: PathBuf,
}

/// Arguments of `vehicle fly`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = FLY_AFTER)]
pub struct VehicleFlyArgs {
    /// Folder of the vehicle, or the name of one that comes with the program.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Table of set-points (CSV): `t_s`, and a column for each drive by the name of its link. A row holds until the
    /// next.
    #[arg(long, value_name = "FILE")]
    pub table: PathBuf,
    /// Where to write the states (CSV).
    #[arg(long, value_name = "FILE", default_value = "flown.csv")]
    pub out: PathBuf,
    /// How long it flies, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    pub lasts_s: f64,
    /// Step, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.02)]
    pub step_s: f64,
    /// Time from row to row of the states, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.1)]
    pub every_s: f64,
    /// Depth at the start, m; its nose is to the north.
    #[arg(long, value_name = "M", default_value_t = 10.0, allow_negative_numbers = true)]
    pub depth_m: f64,
    /// Roll (right side down) and pitch (nose up) at the start, degrees.
    #[arg(long, value_name = "ROLL,PITCH", default_value = "0,0", allow_hyphen_values = true)]
    pub tilt_deg: Numbers<2>,
    /// Velocity through the water at the start: ahead, left, up, m/s.
    #[arg(long, value_name = "AHEAD,LEFT,UP", default_value = "0,0,0", allow_hyphen_values = true)]
    pub velocity: Numbers<3>,
    /// Velocity of the water: east, north, up, m/s.
    #[arg(long, value_name = "EAST,NORTH,UP", default_value = "0,0,0", allow_hyphen_values = true)]
    pub water: Numbers<3>,
    /// Density of the water, kg/m3.
    #[arg(long, value_name = "KG_M3", default_value_t = 1025.0)]
    pub density: f64,
}

const FLY_AFTER: &str = "\
Set-points are inputs of thrusters' curves, angles of fins in rad, volumes in m3, places of masses in m. The states are \
place (ENU), attitude (quaternion, body FLU to ENU), velocity over ground and angular velocity in body axes (FLU), and \
the state of each drive.

Example: rheotaxis vehicle fly my_auv --table tank.csv --velocity 1.5,0,0 --lasts-s 120";

/// Arguments of `vehicle init`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct VehicleInitArgs {
    /// Name of a vehicle that comes with the program.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// Folder to write; it must not exist.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
}
