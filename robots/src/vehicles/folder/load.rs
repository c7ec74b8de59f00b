//! Builds a hull with drives from its file, and refuses what cannot be one.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, sections 3.3 and 6.3
//! (masses are symmetric and positive definite; damping dissipates).
//!
//! *Parameters:* none.
//!
//! *Deviations:* none.

use super::blocks::Damping;
use super::doubts::{resists, symmetric, trim};
use super::driven_hull::{DrivenHull, Rates};
use super::fitted::drives;
use super::hull_blocks::{HullBlocks, given};
use super::plant;
use super::vehicle_source::VehicleSource;
use crate::error::{RobotError, ensure};
use crate::handoff::MOST_DRIVES;
use crate::vehicles::dynamics::{Body, Equation, Mass, cells_of, flip, turned};
use crate::vehicles::motion::Statics;
use crate::vehicles::urdf::Shell;
use nalgebra::{Matrix3, Matrix6, SymmetricEigen, Vector3};

/// Shortest time in which the motion of a hull decays, s; those that come with the program take ten times as long.
const QUICKEST_S: f64 = 1e-3;

impl DrivenHull {
    /// Builds the hull of a vehicle's file.
    ///
    /// # Errors
    /// If it cannot be one.
    pub(in crate::vehicles) fn build(
        source: &VehicleSource,
        shell: &Shell,
        told: &mut Vec<String>,
    ) -> Result<Self, RobotError> {
        let (file, wrong) = (&source.file, |problem: String| source.wrong(problem));
        let Some(pilot) = &file.autopilot else {
            return Err(wrong("autopilot: is missing; say who steers it: Torpedo(), Thrusters() or Glider()".into()));
        };
        let mass = rigid(shell).map_err(|problem| source.urdf.fault(problem))?;
        let given = given(&file.hydrodynamics, &source.urdf, mass.kg, &shell.links, told)?;
        let (body, mut damping) = hull(&given, &mass, shell, told).map_err(wrong)?;
        let drives = drives(&file.drives, shell, told).map_err(wrong)?;
        let equation = Equation::new(body)
            .ok_or_else(|| wrong("hydrodynamics: mass and added mass are singular together".into()))?;
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
        let mut states = [0.0; MOST_DRIVES];
        for (state, drive) in states.iter_mut().zip(&drives) {
            *state = drive.idle();
        }
        let statics = Statics::new(&equation, damping.density_kg_m3, file.hydrodynamics.floats);
        let plant = plant::plant(&statics, &damping, &drives, pilot);
        let capabilities = plant::capabilities(&plant, pilot);
        plant::doubts(pilot, &plant, &capabilities, told).map_err(wrong)?;
        let hull = Self { equation, damping, rates, drives, asked: states, states, statics, plant, capabilities };
        let shortest_s = hull.shortest_s(1.0);
        if shortest_s < QUICKEST_S {
            told.push(format!(
                "hydrodynamics: at 1 m/s its motion decays within {shortest_s:.1e} s, and no hull's does in less than \
                 {QUICKEST_S} s: look at the units of damping, mass and inertia"
            ));
        }
        Ok(hull)
    }
}

/// The URDF's mass, FRD.
fn rigid(shell: &Shell) -> Result<Mass, String> {
    let (kg, p_BG, inertia) = shell.ballast.whole();
    let body = &shell.body;
    let moments = SymmetricEigen::new(inertia).eigenvalues;
    let least = moments.min();
    ensure(least > 0.0, || {
        format!(
            "link \"{body}\": <inertia> must be positive in every direction, but its least moment is {least:.3e} kg m2"
        )
    })?;
    let [a, b, c] = [moments.x, moments.y, moments.z];
    let worst = (a - b - c).max(b - a - c).max(c - a - b);
    ensure(worst <= 1e-6 * moments.max(), || {
        format!(
            "link \"{body}\": no body has moments of inertia of {a:.3e}, {b:.3e} and {c:.3e} kg m2, because one is \
             greater than the sum of the others"
        )
    })?;
    let half_turn = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    Ok(Mass::about_centre(kg, flip(p_BG), &(half_turn * inertia * half_turn)))
}

fn hull(given: &HullBlocks, mass: &Mass, shell: &Shell, told: &mut Vec<String>) -> Result<(Body, Damping), String> {
    let Some(volume_m3) = given.volume_m3 else {
        return Err("hydrodynamics.volume_m3: is missing; give the displaced volume, m3".into());
    };
    if given.added.is_none() {
        told.push("hydrodynamics.added_mass is not given: the water that moves along has no mass".into());
    }
    let added = symmetric(&given.added.unwrap_or_else(Matrix6::zeros), told)?;
    let whole = mass.matrix() + added;
    let least = SymmetricEigen::new(whole).eigenvalues.min();
    ensure(least > 0.0, || {
        format!(
            "hydrodynamics.added_mass: mass and added mass together must be positive in every direction, but their \
             least eigenvalue is {least:.3e}"
        )
    })?;
    if SymmetricEigen::new(added).eigenvalues.min() < -1e-9 * added.amax() {
        told.push(
            "hydrodynamics.added_mass is negative in some direction: water that moves along gives energy away".into(),
        );
    }
    let damping = given.damping.clone();
    resists(&damping, told)?;
    let r_B = given.centre_of_buoyancy.unwrap_or_else(Vector3::zeros);
    let body = Body {
        mass: mass.clone(),
        added,
        volume_m3,
        r_B: flip(r_B),
        gravity_m_s2: given.gravity_m_s2,
        envelope: cells_of(&shell.shapes),
        current_by_yaw_only: false,
    };
    trim(&body, &damping, given.floats, told);
    Ok((body, damping))
}

/// Bounds of the hull's rates, by norms of the damping between roots of the mass.
fn rates(equation: &Equation, damping: &Damping) -> Rates {
    let body = &equation.body;
    let eigen = SymmetricEigen::new(body.mass.matrix() + body.added);
    let roots = Matrix6::from_diagonal(&eigen.eigenvalues.map(|v| 1.0 / v.sqrt()));
    let root = eigen.eigenvectors * roots * eigen.eigenvectors.transpose();
    let size = |block: Matrix6<f64>| (root * block * root).norm();
    let arm = (body.mass.r_G - body.r_B).norm();
    let swing = (body.mass.kg * body.gravity_m_s2 * arm).sqrt() * root.fixed_view::<3, 3>(3, 3).norm();
    let mut by_speed = [0.0; 6];
    for (k, rate) in by_speed.iter_mut().enumerate() {
        let mut column = Matrix6::zeros();
        column.set_column(k, &damping.quadratic.column(k));
        // The derivative of |v|v is 2|v|.
        *rate = 2.0 * size(column);
    }
    by_speed[0] += size(damping.forward);
    let half_turn = turned(&root);
    Rates { mass: [equation.whole_mass_flu(), half_turn], rest: swing + size(damping.linear), by_speed }
}
