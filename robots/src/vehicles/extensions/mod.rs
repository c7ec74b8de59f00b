//! Reads the hydrodynamic coefficients that other simulators keep in extensions of a URDF.
//!
//! *Source:* for each simulator its source code, named in `uuv.rs` and `gz.rs`; T. I. Fossen, "Handbook of Marine Craft
//! Hydrodynamics and Motion Control", 2011, 6.4 for the terms and their names (SNAME 1950).
//!
//! *Parameters:* none.
//!
//! *Deviations:* only `<gazebo><plugin>` directly in the root is read, from a file on which xacro has been run. All
//! simulators differ from Fossen in something (Coriolis terms, the point at which a force acts, filtered
//! accelerations); that is no part of the coefficients and is not copied.

mod gz;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_both;
#[cfg(test)]
mod tests_gz;
#[cfg(test)]
mod tests_wrong;
mod text;
mod uuv;

use super::dynamics::turned;
use nalgebra::{Matrix6, Vector3};
use text::{Node, Report, elements, is_xacro, name};

pub(super) use uuv::SURFACE;

/// Coefficients of a body's equation of motion about the origin of its link, in body axes forward, left, up.
///
/// With ν the velocity through the water (m/s, rad/s), the water's force on the body is
/// −M_A ν̇ − C_A(ν) ν − D ν − D_q |ν| ν − u D_u ν, where column j of D_q multiplies |ν_j| ν_j.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FossenBlocks {
    /// The simulator for which they were written.
    pub(super) source: &'static str,
    /// Name of the link, as in the extension.
    pub(super) link: String,
    /// M_A, positive on its diagonal; kg, kg m, kg m².
    pub(super) added_mass: Matrix6<f64>,
    /// D, positive where it resists.
    pub(super) linear: Matrix6<f64>,
    /// D_q, positive where it resists.
    pub(super) quadratic: Matrix6<f64>,
    /// D_u, positive where it resists in forward motion.
    pub(super) forward: Matrix6<f64>,
    /// Volume of the water displaced; none if the extension does not say, or if the body is [`neutral`](Self::neutral).
    pub(super) volume_m3: Option<f64>,
    /// Whether the body displaces water of its own mass.
    pub(super) neutral: bool,
    /// Centre of buoyancy from the origin of the link, forward, left, up.
    pub(super) centre_of_buoyancy_m: Option<Vector3<f64>>,
    /// Density of the water.
    pub(super) density_kg_m3: Option<f64>,
    /// What the reader was not sure of, each with its line.
    pub(super) doubts: Vec<String>,
}

/// Simulators that are read: part of the plugin's file name, and a reader of all its plugins in a file.
const KINDS: [Kind; 2] = [
    Kind { is_file: |file| file.contains("uuv_underwater_object"), read: uuv::read },
    Kind {
        is_file: |file| {
            file.contains("hydrodynamics-system") && (file.contains("gz-sim") || file.contains("ignition-gazebo"))
        },
        read: gz::read,
    },
];

struct Kind {
    is_file: fn(&str) -> bool,
    read: fn(&[Node<'_>], &mut Report) -> Result<FossenBlocks, String>,
}

/// Without any of these, a file is not looked at.
const MENTIONS: [&str; 3] = ["uuv_underwater_object", "hydrodynamics-system", "xacro"];

/// The coefficients in the text of a URDF; none if it has no extension of a known kind.
///
/// # Errors
/// If an extension of a known kind cannot be read, with line and element.
pub(super) fn read(text: &str) -> Result<Option<FossenBlocks>, String> {
    if !MENTIONS.iter().any(|m| text.contains(m)) {
        return Ok(None);
    }
    let document = text::parse(text)?;
    let mut report = Report::new(text);
    if let Some(node) = document.descendants().find(|n| is_xacro(*n)) {
        return Err(report.fault(node, "is for xacro: run xacro first"));
    }
    let gazebo = elements(document.root_element()).filter(|n| name(*n) == "gazebo");
    let plugins: Vec<Node<'_>> = gazebo.flat_map(elements).filter(|n| name(*n) == "plugin").collect();
    let of = |kind: &Kind| -> Vec<Node<'_>> {
        let file = |n: &Node<'_>| n.attribute("filename").is_some_and(kind.is_file);
        plugins.iter().copied().filter(file).collect()
    };
    let found = KINDS.map(|kind| (of(&kind), kind.read));
    let mut found = found.iter().filter(|(plugins, _)| !plugins.is_empty());
    let Some((plugins, read)) = found.next() else {
        return Ok(None);
    };
    if let Some((others, _)) = found.next() {
        let (one, other) = (report.line(plugins[0]), report.line(others[0]));
        return Err(format!(
            "there is a plugin of uuv_simulator on line {one} and one of gz-sim on line {other}: remove one"
        ));
    }
    let mut blocks = read(plugins, &mut report)?;
    blocks.doubts = report.into_doubts();
    Ok(Some(blocks))
}

/// Minus a matrix, without -0.
fn negated(m: &Matrix6<f64>) -> Matrix6<f64> {
    m.map(|v| 0.0 - v)
}

/// Name of an entry, such as `Y_r` for row 2, column 6.
fn entry(i: usize, j: usize) -> String {
    let letter = |letters: &str, k: usize| letters.chars().nth(k).unwrap_or('?');
    format!("{}_{}", letter("XYZKMN", i), letter("uvwpqr", j))
}

/// Names of the entries for which `is_odd` holds, at most a handful.
fn entries(m: &Matrix6<f64>, is_odd: impl Fn(usize, usize, f64) -> bool) -> Option<String> {
    let all = (0..36).map(|n| (n / 6, n % 6));
    let odd: Vec<String> = all
        .filter(|&(i, j)| is_odd(i, j, m[(i, j)]))
        .map(|(i, j)| format!("{} = {}", entry(i, j), m[(i, j)]))
        .collect();
    match odd.len() {
        0 => None,
        n if n > 6 => Some(format!("{} and {} more", odd[..6].join(", "), n - 6)),
        _ => Some(odd.join(", ")),
    }
}

/// Pairs of entries of an added mass that should be equal and differ by more than rounding.
fn asymmetric(m: &Matrix6<f64>) -> Option<String> {
    entries(m, |i, j, v| {
        let w = m[(j, i)];
        i != j && (v - w).abs() > ROUNDING * v.abs().max(w.abs())
    })
}

/// Relative difference that rounding in a published matrix can cause.
const ROUNDING: f64 = 1e-3;
