//! Refuses hydrodynamic numbers that cannot be a hull's, and tells what is doubtful about others.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, section 6.3 (added mass
//! is symmetric, damping dissipates).
//!
//! *Parameters:* tolerances below.
//!
//! *Deviations:* none.

use super::blocks::Damping;
use crate::error::ensure;
use crate::vehicles::dynamics::Body;
use nalgebra::{Matrix6, SymmetricEigen};

/// Added mass may be asymmetric by this share of its larger diagonal element: it is then averaged, and told.
const ASYMMETRIC: f64 = 0.05;
/// The same below which it is not told.
const ROUNDING: f64 = 1e-9;
/// A vehicle whose weight and buoyancy differ by more than this share is told.
const TRIMMED: f64 = 0.05;

/// Names of the six directions.
const DIRECTIONS: [&str; 6] = ["surge", "sway", "heave", "roll", "pitch", "yaw"];

/// The average of an added mass and its transpose.
pub(super) fn symmetric(added: &Matrix6<f64>, told: &mut Vec<String>) -> Result<Matrix6<f64>, String> {
    for i in 0..6 {
        for j in 0..i {
            let apart = (added[(i, j)] - added[(j, i)]).abs();
            // A product of inertia is compared with the geometric mean: kg m with the root of kg and kg m².
            let scale = (added[(i, i)] * added[(j, j)]).abs().sqrt();
            ensure(apart <= ASYMMETRIC * scale || apart <= ROUNDING, || {
                format!(
                    "hydrodynamics.added_mass: must be symmetric, but row {} column {} is {} and row {} column {} is {}",
                    i + 1,
                    j + 1,
                    added[(i, j)],
                    j + 1,
                    i + 1,
                    added[(j, i)]
                )
            })?;
            if apart > ROUNDING * scale {
                told.push(format!(
                    "hydrodynamics.added_mass is not quite symmetric ({} against {}, {} and {}): the mean is used",
                    added[(i, j)],
                    added[(j, i)],
                    DIRECTIONS[i],
                    DIRECTIONS[j]
                ));
            }
        }
    }
    Ok((added + added.transpose()) / 2.0)
}

/// Damping of the wrong sign is refused; what could feed energy to the hull is told.
pub(super) fn resists(damping: &Damping, told: &mut Vec<String>) -> Result<(), String> {
    for (name, block) in [
        ("linear_damping", &damping.linear),
        ("quadratic_damping", &damping.quadratic),
        ("forward_damping", &damping.forward),
    ] {
        for k in 0..6 {
            ensure(block[(k, k)] >= 0.0, || {
                format!(
                    "hydrodynamics.{name}: {} must be >= 0, got {}: positive damping resists (force = -D v), so change \
                     the signs of a table that prints forces",
                    DIRECTIONS[k],
                    block[(k, k)]
                )
            })?;
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
    if (damping.linear + damping.quadratic + damping.forward).diagonal().min() == 0.0 {
        told.push("hydrodynamics: there is a direction in which nothing resists".into());
    }
    Ok(())
}

/// Tells of a vehicle that sinks, rises or turns over.
pub(super) fn trim(body: &Body, damping: &Damping, floats: bool, told: &mut Vec<String>) {
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
