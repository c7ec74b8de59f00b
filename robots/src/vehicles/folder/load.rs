//! Builds a vehicle from its folder, and refuses what cannot be a vehicle.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, sections 3.3 and 6.3
//! (masses are symmetric and positive definite; damping dissipates).
//!
//! *Parameters:* tolerances below.
//!
//! *Deviations:* none.

use super::blocks::Damping;
use super::described::{Described, Rates};
use super::hydrodynamics_spec::{Axes, Block, HydrodynamicsSpec};
use super::plant;
use super::spec::VehicleFile;
use crate::error::RobotError;
use crate::handoff::MOST_DRIVES;
use crate::vehicles::drives::{Drive, DriveSpec, Fin, Follows, Kind, Thruster, table};
use crate::vehicles::dynamics::{Body, Equation, Mass, cells_of};
use crate::vehicles::files::Files;
use crate::vehicles::urdf::{self, Shell};
use crate::vehicles::urdf_parts::UrdfText;
use nalgebra::{Matrix3, Matrix6, SymmetricEigen, Vector3};
use std::collections::BTreeMap;
use std::path::Path;
use world::frames::Pose;

/// Added mass may be asymmetric by this share of its larger diagonal element: it is then averaged, and told.
const ASYMMETRIC: f64 = 0.05;
/// The same below which it is not told.
const ROUNDING: f64 = 1e-9;
/// A vehicle whose weight and buoyancy differ by more than this share is told.
const TRIMMED: f64 = 0.05;

/// FLU to FRD and back.
fn turned(block: &Matrix6<f64>) -> Matrix6<f64> {
    let sign = |k: usize| if k == 0 || k == 3 { 1.0 } else { -1.0 };
    Matrix6::from_fn(|i, j| sign(i) * sign(j) * block[(i, j)])
}

fn flip(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// A block in FRD; zeros if it is not given.
fn matrix(block: Option<&Block>, axes: Axes) -> Matrix6<f64> {
    let given = match block {
        None => Matrix6::zeros(),
        Some(Block::Diagonal(d)) => Matrix6::from_diagonal(&row(d)),
        Some(Block::Full((a, b, c, d, e, f))) => {
            Matrix6::from_columns(&[a, b, c, d, e, f].map(row)).transpose()
        }
    };
    match axes {
        Axes::Flu => turned(&given),
        Axes::Frd => given,
    }
}

fn row((a, b, c, d, e, f): &super::Row) -> nalgebra::Vector6<f64> {
    nalgebra::Vector6::from([a, b, c, d, e, f].map(|v| v.get()))
}

/// Names of the six directions.
const DIRECTIONS: [&str; 6] = ["surge", "sway", "heave", "roll", "pitch", "yaw"];

impl Described {
    /// Builds a vehicle from the text of its `vehicle.ron`, which stands in a folder of `files`.
    ///
    /// # Errors
    /// If a file cannot be read, or if the vehicle cannot be one.
    pub fn load(folder: &Path, file: &VehicleFile, files: &dyn Files) -> Result<Self, RobotError> {
        let path = files
            .path(&folder.join("vehicle.ron"))
            .display()
            .to_string();
        let wrong = |problem: String| RobotError::File {
            path: path.clone(),
            problem,
        };
        let urdf_path = folder.join(&file.urdf);
        let text = UrdfText::open_at(&urdf_path, files)?;
        let shell = urdf::shell(&text)?;
        let mass = rigid(&shell).map_err(|problem| text.fault(problem))?;
        let mut told = Vec::new();
        let (body, mut damping) =
            hull(&file.hydrodynamics, &mass, &shell, &mut told).map_err(wrong)?;
        let drives = drives(&file.drives, &shell.links).map_err(wrong)?;
        let equation = Equation::new(body).ok_or_else(|| {
            wrong("hydrodynamics: mass and added mass are singular together".into())
        })?;
        if file.hydrodynamics.floats {
            let body = &equation.body;
            let share = body.mass.kg / (damping.density_kg_m3 * body.volume_m3);
            if share >= 1.0 {
                return Err(wrong(format!(
                    "hydrodynamics.floats: it weighs {:.2} kg and displaces at most {:.2} kg, so it sinks",
                    body.mass.kg,
                    damping.density_kg_m3 * body.volume_m3
                )));
            }
            damping.wet = share;
        }
        let rates = rates(&equation, &damping);
        let n = drives.len();
        let mut states = [0.0; MOST_DRIVES];
        for (state, drive) in states.iter_mut().zip(&drives) {
            *state = drive.idle();
        }
        let plant = plant::of(
            &equation,
            &damping,
            &drives,
            &file.autopilot,
            file.hydrodynamics.floats,
        );
        let capabilities = plant::capabilities(&plant, &file.autopilot);
        plant::doubts(&file.autopilot, &plant, &capabilities, &mut told).map_err(wrong)?;
        debug_assert!(n <= MOST_DRIVES);
        Ok(Self {
            name: file.name.clone(),
            shell,
            equation,
            damping,
            rates,
            drives,
            asked: states,
            states,
            told,
            plant,
            capabilities,
        })
    }
}

/// The URDF's mass, FRD.
fn rigid(shell: &Shell) -> Result<Mass, String> {
    let (kg, p_BG, inertia) = shell.ballast.whole();
    let body = &shell.body;
    let moments = SymmetricEigen::new(inertia).eigenvalues;
    let least = moments.min();
    if least <= 0.0 {
        return Err(format!(
            "link \"{body}\": <inertia> must be positive in every direction, but its least moment is {least:.3e} kg m2"
        ));
    }
    let [a, b, c] = [moments.x, moments.y, moments.z];
    let worst = (a - b - c).max(b - a - c).max(c - a - b);
    if worst > 1e-6 * moments.max() {
        return Err(format!(
            "link \"{body}\": no body has moments of inertia of {a:.3e}, {b:.3e} and {c:.3e} kg m2, because one is \
             greater than the sum of the others"
        ));
    }
    let half_turn = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    Ok(Mass::about_centre(
        kg,
        flip(p_BG),
        &(half_turn * inertia * half_turn),
    ))
}

fn hull(
    spec: &HydrodynamicsSpec,
    mass: &Mass,
    shell: &Shell,
    told: &mut Vec<String>,
) -> Result<(Body, Damping), String> {
    let block = |b: &Option<Block>| matrix(b.as_ref(), spec.axes);
    let Some(volume) = spec.volume_m3 else {
        return Err("hydrodynamics.volume_m3: is missing; give the displaced volume, m3".into());
    };
    let volume_m3 = volume.get();
    if spec.added_mass.is_none() {
        told.push(
            "hydrodynamics.added_mass is not given: the water that moves along has no mass".into(),
        );
    }
    let added = symmetric(&block(&spec.added_mass), told)?;
    let whole = mass.matrix() + added;
    let least = SymmetricEigen::new(whole).eigenvalues.min();
    if least <= 0.0 {
        return Err(format!(
            "hydrodynamics.added_mass: mass and added mass together must be positive in every direction, but their \
             least eigenvalue is {least:.3e}"
        ));
    }
    if SymmetricEigen::new(added).eigenvalues.min() < -1e-9 * added.amax() {
        told.push(
            "hydrodynamics.added_mass is negative in some direction: water that moves along gives energy away".into(),
        );
    }
    let damping = Damping {
        linear: block(&spec.linear_damping),
        quadratic: block(&spec.quadratic_damping),
        forward: block(&spec.forward_damping),
        density_kg_m3: spec.density_kg_m3.get(),
        wet: 1.0,
    };
    resists(&damping, told)?;
    let r_B = spec
        .centre_of_buoyancy_m
        .map_or(Vector3::zeros(), |(x, y, z)| {
            Vector3::new(x.get(), y.get(), z.get())
        });
    let body = Body {
        mass: mass.clone(),
        added,
        volume_m3,
        r_B: flip(r_B),
        gravity_m_s2: spec.gravity_m_s2.get(),
        envelope: cells_of(&shell.shapes),
        current_by_yaw_only: false,
    };
    trim(&body, &damping, spec.floats, told);
    Ok((body, damping))
}

/// The average of an added mass and its transpose.
fn symmetric(added: &Matrix6<f64>, told: &mut Vec<String>) -> Result<Matrix6<f64>, String> {
    for i in 0..6 {
        for j in 0..i {
            let apart = (added[(i, j)] - added[(j, i)]).abs();
            // A product of inertia is compared with the geometric mean: kg m with the root of kg and kg m².
            let scale = (added[(i, i)] * added[(j, j)]).abs().sqrt();
            if apart > ASYMMETRIC * scale && apart > ROUNDING {
                return Err(format!(
                    "hydrodynamics.added_mass: must be symmetric, but row {} column {} is {} and row {} column {} is {}",
                    i + 1,
                    j + 1,
                    added[(i, j)],
                    j + 1,
                    i + 1,
                    added[(j, i)]
                ));
            }
            if apart > ROUNDING * scale {
                told.push(format!(
                    "hydrodynamics.added_mass is not quite symmetric ({} against {}, {} and {}): the mean is used",
                    added[(i, j)], added[(j, i)], DIRECTIONS[i], DIRECTIONS[j]
                ));
            }
        }
    }
    Ok((added + added.transpose()) / 2.0)
}

/// Damping of the wrong sign is refused; what could feed energy to the hull is told.
fn resists(damping: &Damping, told: &mut Vec<String>) -> Result<(), String> {
    for (name, block) in [
        ("linear_damping", &damping.linear),
        ("quadratic_damping", &damping.quadratic),
        ("forward_damping", &damping.forward),
    ] {
        for k in 0..6 {
            if block[(k, k)] < 0.0 {
                return Err(format!(
                    "hydrodynamics.{name}: {} must be >= 0, got {}: positive damping resists (force = -D v), so change \
                     the signs of a table that prints forces",
                    DIRECTIONS[k],
                    block[(k, k)]
                ));
            }
        }
        let even = (block + block.transpose()) / 2.0;
        let eigen = SymmetricEigen::new(even).eigenvalues;
        if eigen.min() < -1e-9 * eigen.max().abs() {
            told.push(format!(
                "hydrodynamics.{name} could feed energy to the hull: its symmetric part has the eigenvalue {:.3e}",
                eigen.min()
            ));
        }
    }
    if (damping.linear + damping.quadratic + damping.forward)
        .diagonal()
        .min()
        == 0.0
    {
        told.push("hydrodynamics: there is a direction in which nothing resists".into());
    }
    Ok(())
}

fn trim(body: &Body, damping: &Damping, floats: bool, told: &mut Vec<String>) {
    let displaced = damping.density_kg_m3 * body.volume_m3;
    let excess = body.mass.kg / displaced - 1.0;
    if !floats && excess.abs() > TRIMMED {
        told.push(format!(
            "it weighs {:.2} kg and displaces {displaced:.2} kg of water: {}",
            body.mass.kg,
            if excess > 0.0 { "it sinks" } else { "it rises" }
        ));
    }
    let low = body.mass.r_G.z - body.r_B.z;
    if !floats && low < 0.0 {
        told.push(format!(
            "the centre of gravity is {:.3} m above that of buoyancy: it turns over, or a frame is upside down",
            -low
        ));
    }
}

/// The drives on their links.
fn drives(specs: &[DriveSpec], links: &BTreeMap<String, Pose>) -> Result<Vec<Drive>, String> {
    if specs.len() > MOST_DRIVES {
        return Err(format!(
            "drives: at most {MOST_DRIVES}, got {}",
            specs.len()
        ));
    }
    specs
        .iter()
        .enumerate()
        .map(|(k, spec)| drive(spec, links).map_err(|problem| format!("drives[{k}].{problem}")))
        .collect()
}

fn drive(spec: &DriveSpec, links: &BTreeMap<String, Pose>) -> Result<Drive, String> {
    let at = |link: &str| {
        links.get(link).copied().ok_or_else(|| {
            let near: Vec<&str> = links.keys().map(String::as_str).collect();
            format!(
                "link: no link \"{link}\" in the URDF; it has {}",
                near.join(", ")
            )
        })
    };
    let axis = |pose: &Pose, axis: Vector3<f64>| flip(pose.R_WB * axis);
    Ok(match spec {
        DriveSpec::Thruster(t) => {
            let pose = at(&t.link)?;
            let curve = table(&t.curve).map_err(|problem| format!("curve: {problem}"))?;
            Drive {
                link: t.link.clone(),
                limits: curve.inputs(),
                follows: Follows::Lag(t.lag_s.get()),
                kind: Kind::Thruster(Thruster {
                    r: flip(pose.p_WB),
                    axis: axis(&pose, Vector3::x()),
                    curve,
                    runs_free_m_s: t.runs_free_m_s.map(|v| v.get()),
                    torque_m: t.torque_m.get(),
                    power_w_n: t.power_w_n.get(),
                }),
            }
        }
        DriveSpec::Fin(f) => {
            let pose = at(&f.link)?;
            let limit = f.limit_deg.get().to_radians();
            Drive {
                link: f.link.clone(),
                limits: [-limit, limit],
                follows: Follows::Lag(f.lag_s.get()),
                kind: Kind::Fin(Fin {
                    r: flip(pose.p_WB),
                    chord: axis(&pose, Vector3::x()),
                    lift: axis(&pose, Vector3::z()),
                    area_m2: f.area_m2.get(),
                    slope: f.lift_slope.get(),
                    drag_0: f.drag_0.get(),
                    stall_rad: f.stall_deg.get().to_radians(),
                    plate: f.plate.get(),
                    limit_rad: limit,
                }),
            }
        }
        DriveSpec::BuoyancyEngine(b) => {
            let pose = at(&b.link)?;
            let limit = b.limit_m3.get();
            Drive {
                link: b.link.clone(),
                limits: [-limit, limit],
                follows: Follows::Rate(b.rate_m3_s.get()),
                kind: Kind::Buoyancy(flip(pose.p_WB), b.power_w.get()),
            }
        }
        DriveSpec::MovingMass(m) => {
            let pose = at(&m.link)?;
            let travel = m.travel_m.get();
            Drive {
                link: m.link.clone(),
                limits: [-travel, travel],
                follows: Follows::Rate(m.rate_m_s.get()),
                kind: Kind::Mass(axis(&pose, Vector3::x()), m.mass_kg.get(), m.power_w.get()),
            }
        }
    })
}

/// Bounds of the hull's rates, by norms of the damping between roots of the mass.
fn rates(equation: &Equation, damping: &Damping) -> Rates {
    let body = &equation.body;
    let eigen = SymmetricEigen::new(body.mass.matrix() + body.added);
    let roots = Matrix6::from_diagonal(&eigen.eigenvalues.map(|v| 1.0 / v.sqrt()));
    let root = eigen.eigenvectors * roots * eigen.eigenvectors.transpose();
    let size = |block: Matrix6<f64>| (root * block * root).norm();
    let arm = (body.mass.r_G - body.r_B).norm();
    let swing =
        (body.mass.kg * body.gravity_m_s2 * arm).sqrt() * root.fixed_view::<3, 3>(3, 3).norm();
    let mut by_speed = [0.0; 6];
    for (k, rate) in by_speed.iter_mut().enumerate() {
        let mut column = Matrix6::zeros();
        column.set_column(k, &damping.quadratic.column(k));
        // The derivative of |v|v is 2|v|.
        *rate = 2.0 * size(column);
    }
    by_speed[0] += size(damping.forward);
    let half_turn = turned(&root);
    Rates {
        mass: [equation.whole_mass_flu(), half_turn],
        rest: swing + size(damping.linear),
        by_speed,
    }
}
