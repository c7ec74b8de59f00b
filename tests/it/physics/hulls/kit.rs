//! Shipped vehicles to be changed, and water without surprises.

use nalgebra::{Matrix3, Matrix6, Vector3};
use rheotaxis::scenario::FolderFiles;
use robots::handoff::{Actuation, DriveCommand, PilotSpec, ThrustersSpec};
use robots::vehicles::{
    Axes, Block, CurveSpec, DriveSpec, Files, HydrodynamicsSpec, InMemory, ShippedVehicle, TermsSpec, ThrusterSpec,
    Vehicle, VehicleFile, VehicleSpec,
};
use std::path::Path;
use tempfile::TempDir;
use world::fields::WaterSample;
use world::math;
use world::ranges::{Finite, NonNegative, Positive};
use world::seeds::Stream;

/// A shipped vehicle's file and URDF.
pub(super) fn shipped(name: &str) -> (VehicleFile, String) {
    let shipped = ShippedVehicle::named(name).expect("it is shipped");
    let file = FolderFiles(Path::new("")).vehicle(name, shipped.file).unwrap_or_else(|e| panic!("{e}"));
    (file, shipped.urdf.1.to_string())
}

/// A text with pieces changed, each of which must be in it.
#[track_caller]
pub(super) fn with(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_string(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    })
}

/// A folder with the vehicle `hull` of a `vehicle.ron` and a URDF of this name.
pub(super) fn folder(vehicle: &str, urdf: (&str, &str)) -> TempDir {
    let dir = tempfile::tempdir().expect("a folder");
    let at = dir.path().join("hull");
    std::fs::create_dir(&at).expect("a folder");
    std::fs::write(at.join("vehicle.ron"), vehicle).expect("a file");
    std::fs::write(at.join(urdf.0), urdf.1).expect("a file");
    dir
}

/// The same of a shipped vehicle with both texts changed.
#[track_caller]
pub(super) fn changed(name: &str, ron: &[(&str, &str)], urdf: &[(&str, &str)]) -> TempDir {
    let shipped = ShippedVehicle::named(name).expect("it is shipped");
    folder(&with(shipped.file, ron), (shipped.urdf.0, &with(shipped.urdf.1, urdf)))
}

/// The vehicle `hull` of a folder.
pub(super) fn load(dir: &TempDir) -> Result<Vehicle, String> {
    Vehicle::load(&VehicleSpec::File("hull".into()), &FolderFiles(dir.path())).map_err(|e| e.to_string())
}

/// The vehicle of a file and a URDF.
pub(super) fn built(file: &VehicleFile, urdf: &str) -> Vehicle {
    let files = InMemory::default().with(&format!("it/{}", file.urdf), urdf.as_bytes());
    Vehicle::of_file("it", file, &files).unwrap_or_else(|e| panic!("{e}"))
}

/// Set-points of a vehicle with drives.
pub(super) fn set(values: &[f64]) -> Actuation {
    Actuation::Drives(DriveCommand::new(values))
}

/// A thruster whose input is its thrust, at once.
pub(super) fn newtons(link: &str) -> DriveSpec {
    DriveSpec::Thruster(ThrusterSpec {
        link: link.into(),
        curve: CurveSpec::Newtons((Finite::new(-1000.0), Finite::new(1000.0))),
        lag_s: NonNegative::new(0.0),
        runs_free_m_s: None,
        torque_m: Finite::new(0.0),
        power_w_n: NonNegative::new(0.0),
    })
}

/// Still water of a density, kg/m³.
pub(super) fn still(density_kg_m3: f64) -> WaterSample {
    WaterSample { velocity: Vector3::zeros(), gradient: Matrix3::zeros(), rate: Vector3::zeros(), density_kg_m3 }
}

fn between(rng: &mut Stream, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.uniform()
}

/// A link at a place beside the body.
pub(super) fn side(name: &str, y: f64) -> String {
    format!(
        "<link name=\"{name}\"/><joint name=\"{name}_joint\" type=\"fixed\"><parent link=\"base_link\"/>\
         <child link=\"{name}\"/><origin xyz=\"0 {y} 0\"/></joint>"
    )
}

fn diagonal(values: [f64; 6]) -> Block {
    let [a, b, c, d, e, f] = values.map(Finite::new);
    Block::Diagonal((a, b, c, d, e, f))
}

fn full(m: &Matrix6<f64>) -> Block {
    let row = |i: usize| {
        let at = |j: usize| Finite::new(m[(i, j)]);
        (at(0), at(1), at(2), at(3), at(4), at(5))
    };
    Block::Full(Box::new((row(0), row(1), row(2), row(3), row(4), row(5))))
}

/// A symmetric matrix without a negative direction, of the size of a hull's forces and moments.
fn positive(rng: &mut Stream, force: f64, arm_m: f64) -> Matrix6<f64> {
    let root = Matrix6::from_fn(|_, _| between(rng, -1.0, 1.0) * force.sqrt() / 2.0);
    let scale = |k: usize| if k < 3 { 1.0 } else { arm_m };
    let square: Matrix6<f64> = root * root.transpose();
    Matrix6::from_fn(|i, j| square[(i, j)] * scale(i) * scale(j))
}

/// A hull within the limits of `check`, about which it has no doubt of energy.
pub(super) fn random_hull(rng: &mut Stream) -> Vehicle {
    let size = math::exp(between(rng, -2.0, 1.5));
    let kg = 200.0 * size * size * size * between(rng, 0.3, 3.0);
    let arms = [0, 1, 2].map(|_| size * between(rng, 0.1, 0.5));
    let [ixx, iyy, izz] = [(1, 2), (0, 2), (0, 1)].map(|(i, j)| kg * (arms[i] * arms[i] + arms[j] * arms[j]) / 2.0);
    let g = [0, 1, 2].map(|_| 0.05 * size * between(rng, -1.0, 1.0));
    let urdf = format!(
        "<robot name=\"r\"><link name=\"base_link\"><inertial><origin xyz=\"{} {} {}\"/><mass value=\"{kg}\"/>\
         <inertia ixx=\"{ixx}\" ixy=\"0\" ixz=\"0\" iyy=\"{iyy}\" iyz=\"0\" izz=\"{izz}\"/></inertial>\
         <collision><geometry><sphere radius=\"{size}\"/></geometry></collision></link>\
         {}{}</robot>",
        g[0],
        g[1],
        g[2],
        side("left", size),
        side("right", -size)
    );
    let drag = 500.0 * size * size * between(rng, 0.0, 2.0);
    let mut quadratic = [0.0; 6];
    for (k, v) in quadratic.iter_mut().enumerate() {
        let arm = if k < 3 { 1.0 } else { size * size * size };
        *v = drag * arm * between(rng, 0.0, 1.0);
    }
    let file = VehicleFile {
        name: "random".into(),
        what: String::new(),
        source: String::new(),
        urdf: "r.urdf".into(),
        hydrodynamics: HydrodynamicsSpec {
            terms: TermsSpec::Blocks,
            axes: Axes::Flu,
            from_urdf: false,
            volume_m3: Some(Positive::new(kg / 1025.0 * between(rng, 0.95, 1.05))),
            centre_of_buoyancy_m: Some((
                Finite::new(g[0]),
                Finite::new(g[1]),
                Finite::new(g[2] + 0.1 * size * between(rng, 0.0, 1.0)),
            )),
            added_mass: Some(full(&positive(rng, 2.0 * kg, size))),
            linear_damping: Some(full(&positive(rng, drag, size))),
            quadratic_damping: Some(diagonal(quadratic)),
            forward_damping: Some(full(&positive(rng, 0.3 * drag, size))),
            density_kg_m3: Positive::new(1025.0),
            gravity_m_s2: Positive::new(9.80665),
            floats: false,
        },
        drives: ["left", "right"].map(newtons).to_vec(),
        autopilot: Some(PilotSpec::Thrusters(ThrustersSpec::default())),
    };
    built(&file, &urdf)
}
