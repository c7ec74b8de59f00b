//! Reads the plugin `uuv_underwater_object` of uuv_simulator and of its successor Plankton.
//!
//! *Source:* github.com/uuvsimulator/uuv_simulator, `uuv_gazebo_plugins/uuv_gazebo_plugins/src`:
//! `HydrodynamicModel.cc` (commit bea0a1b), `BuoyantObject.cc` (0abaafc), `UnderwaterObjectPlugin.cc` (d28279e); with
//! scalings, which no file sets, `HydrodynamicModel.cpp` of github.com/Liquid-ai/Plankton (23f835d). There, with ν in
//! axes forward, right, down,
//!
//! ```text
//! force = −Ma ν̇ − Ca(ν) ν − D ν,   D = −DLin − u DLinForwardSpeed − diag(DNonLin) |ν|
//! ```
//!
//! so added mass is positive and damping is negative where it resists. The centre of buoyancy is in the link's own
//! axes, forward, left, up. The first versions (0db0649) did not turn the axes; that changes entries off the diagonal.
//!
//! *Parameters:* none.
//!
//! *Deviations:* `<added_mass>` may have 6 numbers, which uuv_simulator refuses. Of `<quadratic_damping>` only the
//! diagonal is read, as there. Water has no default density (there: 1028 kg/m³). Hydrodynamics computed from a shape
//! (`sphere`, `cylinder`, `spheroid`, `box`) and the terms of surface vessels are not read.

use super::text::{Node, Report, Use, elements, name, quote};
use super::{FossenBlocks, asymmetric, entries, negated, turned};
use nalgebra::{Matrix6, Vector3};

const IGNORED: &str = "ignored: uuv_simulator has no such element";
/// Of what is of no use to a hull under water. One that floats does so by its volume and its shapes.
pub(in crate::vehicles) const SURFACE: &str =
    "ignored: the body is taken as under water; `floats: true` takes it as a craft on the surface";
const SERVICE: &str = "ignored, as in uuv_simulator, where only a service can set it while it runs";
const SHAPES: [&str; 4] = ["sphere", "cylinder", "spheroid", "box"];

/// The coefficients of the one link that has some.
pub(super) fn read(plugins: &[Node<'_>], report: &mut Report) -> Result<FossenBlocks, String> {
    let (plugin, link) = the_link(plugins, report)?;
    let around = report.sorted(plugin, |name| match name {
        "fluid_density" => Use::Read,
        "link" | "flow_velocity_topic" | "use_global_current" | "debug" => Use::Skip,
        _ => Use::Doubt(IGNORED),
    })?;
    let body = report.sorted(link, |name| match name {
        "volume" | "center_of_buoyancy" | "neutrally_buoyant" | "hydrodynamic_model" => Use::Read,
        // Lets the volume fall near the surface.
        "box" => Use::Skip,
        "metacentric_width" | "metacentric_length" | "water_level_plane_area" | "submerged_height" => {
            Use::Doubt(SURFACE)
        }
        _ => Use::Doubt(unknown(name)),
    })?;
    let model = body["hydrodynamic_model"];
    let terms = report.sorted(model, |name| match name {
        "type" | "added_mass" | "linear_damping" | "linear_damping_forward_speed" | "quadratic_damping" => Use::Read,
        _ => Use::Doubt(unknown(name)),
    })?;
    let kind = *terms.get("type").ok_or_else(|| report.fault(model, "<type> is missing"))?;
    check_type(kind, report)?;

    let neutral = match body.get("neutrally_buoyant") {
        Some(node) => report.is_true(*node)?,
        None => false,
    };
    let mut volume_m3 = None;
    if let Some(node) = body.get("volume") {
        if neutral {
            report.doubt(*node, "ignored, because <neutrally_buoyant> is true");
        } else {
            volume_m3 = Some(report.positive(*node)?);
        }
    }
    let term = |what: &str| terms.get(what).copied();
    Ok(FossenBlocks {
        source: "uuv_simulator",
        link: report.text_of(link, Some("name"))?,
        added_mass: added_mass(model, term("added_mass"), report)?,
        linear: damping(model, term("linear_damping"), false, report)?,
        quadratic: damping(model, term("quadratic_damping"), true, report)?,
        forward: match term("linear_damping_forward_speed") {
            None => Matrix6::zeros(),
            given => damping(model, given, false, report)?,
        },
        volume_m3,
        neutral,
        centre_of_buoyancy_m: match body.get("center_of_buoyancy") {
            Some(node) => Some(place(*node, report)?),
            None => None,
        },
        density_kg_m3: match around.get("fluid_density") {
            Some(node) => Some(report.positive(*node)?),
            None => None,
        },
        doubts: Vec::new(),
    })
}

/// The link with a model, and its plugin.
fn the_link<'a>(plugins: &[Node<'a>], report: &mut Report) -> Result<(Node<'a>, Node<'a>), String> {
    let mut found: Option<(Node<'a>, Node<'a>)> = None;
    for plugin in plugins {
        for link in elements(*plugin).filter(|n| name(*n) == "link") {
            if !elements(link).any(|n| name(n) == "hydrodynamic_model") {
                report.doubt(link, "ignored: it has no <hydrodynamic_model>");
            } else if let Some((_, first)) = found {
                let first = report.line(first);
                return Err(report.fault(
                    link,
                    &format!("has a <hydrodynamic_model>, and so has the link on line {first}: a vehicle can have one"),
                ));
            } else {
                found = Some((*plugin, link));
            }
        }
    }
    found.ok_or_else(|| report.fault(plugins[0], "has no <link> with a <hydrodynamic_model>"))
}

/// Refuses what is not a table of coefficients.
fn check_type(node: Node<'_>, report: &Report) -> Result<(), String> {
    let kind = report.text_of(node, None)?;
    if kind == "fossen" {
        return Ok(());
    }
    let problem = if SHAPES.contains(&kind.as_str()) {
        format!("\"{kind}\" computes coefficients from a shape, which is not supported")
    } else {
        format!("\"{}\" is not a type of uuv_simulator", quote(&kind))
    };
    Err(report.fault(node, &format!("{problem}: only \"fossen\" is read")))
}

fn unknown(name: &str) -> &'static str {
    if name.starts_with("scaling_") || name.starts_with("offset_") || name.ends_with("_scaling") {
        SERVICE
    } else {
        IGNORED
    }
}

fn place(node: Node<'_>, report: &Report) -> Result<Vector3<f64>, String> {
    match report.numbers(node)?[..] {
        [x, y, z] => Ok(Vector3::new(x, y, z)),
        ref other => {
            let problem = format!("needs 3 numbers, got {}", other.len());
            Err(report.fault(node, &problem))
        }
    }
}

/// The added mass; the axes are turned.
fn added_mass(model: Node<'_>, node: Option<Node<'_>>, report: &mut Report) -> Result<Matrix6<f64>, String> {
    let Some(node) = node else {
        report.doubt(model, "has no <added_mass>: taken as zero");
        return Ok(Matrix6::zeros());
    };
    let (m, full) = report.matrix(node)?;
    if !full {
        report.doubt(node, "6 numbers are taken as the diagonal; uuv_simulator itself needs 36");
    }
    if let Some(odd) = entries(&m, |i, j, v| i == j && v < 0.0) {
        report.doubt(node, &format!("is negative in {odd}: read as it stands, so it takes mass away"));
    }
    if let Some(odd) = asymmetric(&m) {
        report.doubt(node, &format!("is not symmetric in {odd}: read as it stands"));
    }
    Ok(turned(&m))
}

/// A damping; sign and axes are turned.
fn damping(
    model: Node<'_>,
    node: Option<Node<'_>>,
    only_diagonal: bool,
    report: &mut Report,
) -> Result<Matrix6<f64>, String> {
    let Some(node) = node else {
        let which = if only_diagonal { "quadratic" } else { "linear" };
        report.doubt(model, &format!("has no <{which}_damping>: taken as zero"));
        return Ok(Matrix6::zeros());
    };
    let (mut m, _) = report.matrix(node)?;
    if let Some(odd) = entries(&m, |i, j, v| i == j && v > 0.0) {
        report.doubt(
            node,
            &format!(
                "is positive in {odd}: read as uuv_simulator does, so it drives the body on; what resists is negative"
            ),
        );
    }
    if only_diagonal {
        if let Some(odd) = entries(&m, |i, j, v| i != j && v != 0.0) {
            report.doubt(node, &format!("{odd} off the diagonal: ignored, as in uuv_simulator"));
        }
        m = Matrix6::from_diagonal(&m.diagonal());
    }
    Ok(negated(&turned(&m)))
}
