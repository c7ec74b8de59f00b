//! Arguments of `rheotaxis vehicle`.

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
  rheotaxis vehicle trials my_auv           speed, turning circle, zigzag, dive, stop, station keeping

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
    /// Write a copy of a shipped vehicle to start from.
    Init(VehicleInitArgs),
}

/// Arguments of `vehicle check`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct VehicleCheckArgs {
    /// Folder of the vehicle, or the name of one that comes with the program.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Where to draw it, as SVG or PNG by its ending [default: FOLDER.svg in the present folder].
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Arguments of `vehicle trials`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct VehicleTrialsArgs {
    /// Folder of the vehicle, the name of one that comes with the program, or `remus100`.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Folder for `trials.csv`, `trials.svg` and `trials.png`.
    #[arg(long, value_name = "DIR", default_value = "trials")]
    pub out: PathBuf,
}

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
