//! `rheotaxis vehicle`: checks a vehicle of a folder, draws it, and runs its trials.

mod fly;

use crate::args::vehicle::{VehicleArgs, VehicleCheckArgs, VehicleCommand, VehicleInitArgs, VehicleTrialsArgs};
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::say;
use fly::flown;
use nalgebra::Vector3;
use output::charts::png;
use output::files::{beside_no_run, write_whole};
use rheotaxis::scenario::FolderFiles;
use robots::guide::GuidanceSpec;
use robots::handoff::{Capabilities, Control, DriveEffect};
use robots::vehicles::{
    CATALOGUE, KinematicSpec, SHIPPED, ShippedVehicle, Statics, Vehicle, VehicleDrive, VehicleSpec,
};
use std::path::{Path, PathBuf};
use studies::trials::{Looks, Trial, drawn, figure, has_rudder, numbers_csv, steering_csv, trials};
use world::files::make_folder;

/// Runs a subcommand.
pub(crate) fn vehicle(args: &VehicleArgs) -> Result<Exit, Failure> {
    match &args.command {
        VehicleCommand::Check(args) => check(args),
        VehicleCommand::Trials(args) => on_trial(args),
        VehicleCommand::Fly(args) => flown(args, &loaded(&args.folder)?),
        VehicleCommand::Init(args) => init(args),
    }?;
    Ok(Exit::Success)
}

/// A folder of the user's own, or a vehicle that `rheotaxis list vehicles` names; letters count as small ones.
fn spec(folder: &Path) -> Result<VehicleSpec, Failure> {
    let name = folder.to_string_lossy().trim_end_matches('/').to_string();
    if folder.is_dir() {
        return Ok(VehicleSpec::File(name));
    }
    let hint = match name.to_ascii_lowercase().as_str() {
        "kinematic" => return Ok(VehicleSpec::Kinematic(KinematicSpec::default())),
        low if ShippedVehicle::named(low).is_some() => return Ok(VehicleSpec::Shipped(low.to_string())),
        "shipped" => format!("name its folder: {}", names()),
        "file" => "name your folder itself, such as my_auv".to_string(),
        _ if CATALOGUE.iter().any(|e| e.name.eq_ignore_ascii_case(&name)) => {
            "only what moves freely in the water has trials; `rheotaxis run flume_crab` runs the gantry".to_string()
        }
        _ => {
            return Err(hinted(
                format!("{name}: there is no such folder, and no such vehicle comes with the program"),
                format!("vehicles that come with the program: kinematic, {}", names()),
            ));
        }
    };
    Err(hinted(format!("{name} is a word of scenario files and no vehicle by itself"), hint))
}

fn names() -> String {
    let names: Vec<&str> = SHIPPED.iter().map(|s| s.folder).collect();
    names.join(", ")
}

/// Name of a vehicle for people.
fn title(craft: &Vehicle) -> &str {
    match craft.control() {
        Control::Rates(_) => "Kinematic, with its default limits",
        Control::Fins | Control::Drives(_) => craft.name(),
    }
}

fn loaded(folder: &Path) -> Result<Vehicle, Failure> {
    Ok(Vehicle::load(&spec(folder)?, &FolderFiles(Path::new("")))?)
}

/// A name for files, from a folder.
fn stem(folder: &Path) -> String {
    folder.file_name().map_or("vehicle".into(), |n| n.to_string_lossy().into_owned())
}

fn check(args: &VehicleCheckArgs) -> Result<(), Failure> {
    let craft = loaded(&args.folder)?;
    for doubt in craft.doubts() {
        say::line(format_args!("doubt: {doubt}"));
    }
    say::line(title(&craft));
    let Some(statics) = craft.statics() else {
        print_capabilities(&craft);
        say::line("its numbers are a part of the scenario: there is no folder to check or to draw");
        return Ok(());
    };
    print(&craft, &statics);
    let out = (args.out.clone()).unwrap_or_else(|| PathBuf::from(format!("{}.svg", stem(&args.folder))));
    let svg = drawn(&looks(&craft, &statics));
    if out.extension().is_some_and(|e| e == "png") {
        write_whole(&out, &png(&svg)?)?;
    } else {
        write_whole(&out, svg.as_bytes())?;
    }
    say::line(out.display());
    let n = craft.doubts().len();
    say::line(match n {
        0 => "no doubts".to_string(),
        n => say::count(n as u64, "doubt"),
    });
    Ok(())
}

/// What follows from its file, in numbers.
fn print(craft: &Vehicle, statics: &Statics) {
    let Statics { mass_kg, whole_mass, heavy_n, righting_n_m, .. } = statics;
    let surging = whole_mass[(0, 0)];
    say::line(format_args!(
        "  mass                    {mass_kg:.3} kg, {surging:.3} kg with the water that surges along"
    ));
    say::line(format_args!(
        "  weight less buoyancy    {heavy_n:.2} N in water of 1025 kg/m3, or of the density of its file"
    ));
    say::line(format_args!(
        "  righting moment         {righting_n_m:.2} N m at 1 rad; period in roll {}, in pitch {}",
        period(*righting_n_m, whole_mass[(3, 3)]),
        period(*righting_n_m, whole_mass[(4, 4)])
    ));
    print_capabilities(craft);
    for (k, drive) in craft.drives().iter().enumerate() {
        let link = &drive.named.name;
        let [least, most] = drive.limits;
        let (does, acts) = match &drive.does {
            DriveEffect::Pushes(_, table) => {
                let [astern, ahead] = table.thrusts_n();
                (format!("thruster, {astern:.1} to {ahead:.1} N at inputs from {least} to {most}"), "pushes along")
            }
            DriveEffect::Lifts(_) => (
                format!("fin, {:.1} to {:.1} degrees", least.to_degrees(), most.to_degrees()),
                "a positive angle pushes along",
            ),
            DriveEffect::Swells(_) => {
                (format!("buoyancy engine, {least} to {most} m3"), "a positive volume lifts along")
            }
            DriveEffect::Shifts(_, kg) => (format!("moving mass of {kg} kg, {least} to {most} m"), "slides along"),
        };
        say::line(format_args!("  drive {:<2} {link:<24} {does}", k + 1));
        let [at, way] = [place(craft, drive), drive.way].map(triple);
        say::line(format_args!("           at {at} m, {acts} {way}"));
    }
    say::line("           (forward, left, up, from the origin of the first link)");
}

fn print_capabilities(craft: &Vehicle) {
    for line in capabilities(&craft.capabilities(GuidanceSpec::default().tightest_turn_m())) {
        say::line(format_args!("  {line}"));
    }
}

/// Where a drive sits.
fn place(craft: &Vehicle, drive: &VehicleDrive) -> Vector3<f64> {
    craft.mount(&drive.named.name).expect("its link is there").p_WB
}

/// Three numbers, without -0.
fn triple(v: Vector3<f64>) -> String {
    let [x, y, z] = [v.x, v.y, v.z].map(|c| (1e3 * c).round() / 1e3 + 0.0);
    format!("({x:.3}, {y:.3}, {z:.3})")
}

fn period(righting: f64, inertia: f64) -> String {
    if righting <= 0.0 {
        return "none".into();
    }
    format!("{:.2} s", std::f64::consts::TAU * (inertia / righting).sqrt())
}

/// What a vehicle can do, a line each.
pub(super) fn capabilities(able: &Capabilities) -> [String; 3] {
    let yes = |b: bool| if b { "yes" } else { "no" };
    [
        format!(
            "speed through the water {:.2} m/s at most, {:.2} m/s at least",
            able.top_speed_m_s, able.least_speed_m_s
        ),
        format!("turning radius          {:.1} m", able.turning_radius_m),
        format!(
            "hovers {}, goes sideways {}, dives {}, holds a depth {}",
            yes(able.hovers),
            yes(able.sideways),
            yes(able.dives),
            yes(able.holds_depth)
        ),
    ]
}

fn looks(craft: &Vehicle, statics: &Statics) -> Looks {
    Looks {
        name: craft.name().to_string(),
        shapes: craft.visuals().to_vec(),
        centres: statics.centres,
        drives: (craft.drives().iter().zip(1..)).map(|(drive, k)| (place(craft, drive), drive.way, k)).collect(),
    }
}

fn on_trial(args: &VehicleTrialsArgs) -> Result<(), Failure> {
    beside_no_run(&args.out.join("trials.csv"))?;
    let craft = loaded(&args.folder)?;
    let name = title(&craft);
    say::line(format_args!("{name}: trials in water of 1025 kg/m3, steps of 0.02 s"));
    let all = trials(&craft);
    let is_lost = |trial: &&Trial| trial.found.iter().any(|f| f.value.is_some_and(|v| !v.is_finite()));
    if let Some(trial) = all.iter().find(is_lost) {
        return Err(hinted(
            format!("{}: the state of {name} is not a number any more: a force on it is too great", trial.name),
            "look at masses, damping and drives in its folder",
        ));
    }
    for trial in &all {
        say::line(trial.name);
        for found in &trial.found {
            let value = found.value.map_or("not reached".to_string(), |v| format!("{v:.3} {}", found.unit));
            say::line(format_args!("  {:<42} {value}", found.what));
        }
    }
    make_folder(&args.out).map_err(|e| format!("{}: {e}", args.out.display()))?;
    let svg = figure(name, &all);
    let mut files = vec![
        ("trials.csv", numbers_csv(&all).into_bytes()),
        ("trials.png", png(&svg)?),
        ("trials.svg", svg.into_bytes()),
    ];
    if has_rudder(&craft) {
        files.push(("steering.csv", steering_csv(&all).into_bytes()));
    } else {
        say::line("it has no rudder: no turning circle and no zigzag by rudder (IMO MSC.137(76))");
    }
    for (file, bytes) in files {
        let path = args.out.join(file);
        write_whole(&path, &bytes)?;
        say::line(path.display());
    }
    Ok(())
}

fn init(args: &VehicleInitArgs) -> Result<(), Failure> {
    let Some(shipped) = ShippedVehicle::named(&args.name) else {
        return Err(hinted(
            format!("no vehicle \"{}\" comes with the program", args.name),
            format!("there are {}", names()),
        ));
    };
    if args.folder.exists() {
        return Err(hinted(format!("{} exists already", args.folder.display()), "name a new folder"));
    }
    make_folder(&args.folder).map_err(|e| format!("{}: {e}", args.folder.display()))?;
    for (name, text) in [("vehicle.ron", shipped.file), shipped.urdf] {
        let path = args.folder.join(name);
        write_whole(&path, text.as_bytes())?;
        say::line(path.display());
    }
    Ok(())
}
