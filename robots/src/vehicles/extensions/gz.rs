//! Reads the system `Hydrodynamics` of Gazebo (gz-sim, formerly ignition-gazebo).
//!
//! *Source:* github.com/gazebosim/gz-sim, `src/systems/hydrodynamics/Hydrodynamics.cc` and `.hh` (commits 775ba7d,
//! 2e8d6ea; before 2022: 01d9d94), and its pull requests 1617, 1784 and 1888. There, with ν in the link's own axes
//! (forward, left, up),
//!
//! ```text
//! force_i = Ma_ij ν̇_j + linear_ij ν_j + abs_ijk ν_j |ν_k| + plain_ijk ν_j ν_k + Coriolis
//! ```
//!
//! of elements `<yDotR>`, `<yR>`, `<yRabsR>` and `<yRP>`: stability derivatives, negative where they resist. Added mass
//! was positive until pull request 1617 (July 2022) and is negative since. Missing elements are zero since pull
//! request 1784 (November 2022).
//!
//! *Parameters:* none.
//!
//! *Deviations:* a positive added mass is taken as one of before 2022, not as one that makes the body unstable.
//! `<xUU>` to `<nRR>` mean |u|u, as until pull request 1784, not u². Of other products, those with u are read and the
//! rest is refused. Volume and centre of buoyancy are not in this plugin; Gazebo takes them from the collision shapes.

use super::text::{Node, Report, Use, name};
use super::{FossenBlocks, asymmetric, entries, negated};
use nalgebra::Matrix6;

const IGNORED: &str = "ignored: the plugin has no such element";
const CURRENT: &str = "ignored: the current is part of the scenario";

/// A coefficient by its indices.
#[derive(Clone, Copy)]
enum Term {
    Added(usize, usize),
    Linear(usize, usize),
    /// Of ν_j |ν_k|.
    Abs(usize, usize, usize),
    /// Of ν_j ν_k.
    Plain(usize, usize, usize),
}

/// What an element's name says.
fn term(name: &str) -> Option<Term> {
    let axis = |c: char| "UVWPQR".find(c);
    let i = "xyzkmn".find(name.chars().next()?)?;
    let rest: Vec<char> = name.chars().skip(1).take(6).collect();
    match rest[..] {
        ['D', 'o', 't', j] => Some(Term::Added(i, axis(j)?)),
        [j] => Some(Term::Linear(i, axis(j)?)),
        [j, 'a', 'b', 's', k] => Some(Term::Abs(i, axis(j)?, axis(k)?)),
        [j, k] => Some(Term::Plain(i, axis(j)?, axis(k)?)),
        _ => None,
    }
}

/// The coefficients of the one plugin that has some.
pub(super) fn read(plugins: &[Node<'_>], report: &mut Report) -> Result<FossenBlocks, String> {
    let plugin = the_plugin(plugins, report)?;
    let all = report.sorted(plugin, |name| match name {
        "link_name" | "water_density" | "waterDensity" | "disable_coriolis" | "disable_added_mass" => Use::Read,
        "namespace" => Use::Skip,
        "default_current" | "lookup_current_x" | "lookup_current_y" | "lookup_current_z" => Use::Doubt(CURRENT),
        _ if term(name).is_some() => Use::Read,
        _ => Use::Doubt(IGNORED),
    })?;
    let native = |n: &Node<'_>| name(*n) == "fluid_added_mass";
    if let Some(node) = plugin.document().descendants().find(native) {
        report.doubt(node, "ignored: only the plugin's added mass is read");
    }
    let link = *all.get("link_name").ok_or_else(|| report.fault(plugin, "<link_name> is missing"))?;
    let link_name = report.text_of(link, None)?;
    if link_name.is_empty() {
        return Err(report.fault(link, "is empty"));
    }

    let mut sums = Sums::default();
    for (tag, node) in &all {
        if let Some(term) = term(tag) {
            sums.add(term, *node, report)?;
        }
    }
    let switch = |tag: &str, report: &Report| match all.get(tag) {
        Some(node) => Ok::<_, String>(report.is_true(*node)?.then_some(*node)),
        None => Ok(None),
    };
    if let Some(node) = switch("disable_coriolis", report)? {
        report.doubt(node, "ignored: the Coriolis force of the added mass acts here");
    }
    let without = switch("disable_added_mass", report)?;
    if let Some(node) = without {
        report.doubt(node, "is true: the added mass is taken as zero");
        sums.added = Matrix6::zeros();
    }
    Ok(FossenBlocks {
        source: "gz-sim",
        link: link_name,
        added_mass: added_mass(plugin, &sums.added, report)?,
        linear: damping(plugin, "linear", &sums.linear, report),
        quadratic: damping(plugin, "quadratic", &sums.quadratic, report),
        forward: negated(&sums.forward),
        volume_m3: None,
        neutral: false,
        centre_of_buoyancy_m: None,
        density_kg_m3: match (all.get("water_density"), all.get("waterDensity")) {
            (Some(node), None) => Some(report.positive(*node)?),
            (given, Some(old)) => {
                let node = given.unwrap_or(old);
                report.doubt(*old, "is the former name of <water_density>");
                Some(report.positive(*node)?)
            }
            (None, None) => None,
        },
        doubts: Vec::new(),
    })
}

/// The plugin with coefficients.
fn the_plugin<'a>(plugins: &[Node<'a>], report: &mut Report) -> Result<Node<'a>, String> {
    let is_model = |n: &Node<'_>| n.children().any(|c| c.is_element() && term(name(c)).is_some());
    let mut found: Option<Node<'a>> = None;
    for plugin in plugins {
        match found {
            _ if !is_model(plugin) && plugins.len() > 1 => {
                report.doubt(*plugin, "ignored: it has no coefficient");
            }
            Some(first) => {
                let first = report.line(first);
                return Err(report.fault(
                    *plugin,
                    &format!("has coefficients, and so has the plugin on line {first}: a vehicle can have one"),
                ));
            }
            None => found = Some(*plugin),
        }
    }
    found.filter(is_model).ok_or_else(|| report.fault(plugins[0], "has no coefficient, such as <xDotU> or <xU>"))
}

/// The coefficients as matrices, with their signs as in the file.
#[derive(Default)]
struct Sums {
    added: Matrix6<f64>,
    linear: Matrix6<f64>,
    quadratic: Matrix6<f64>,
    forward: Matrix6<f64>,
}

impl Sums {
    fn add(&mut self, term: Term, node: Node<'_>, report: &mut Report) -> Result<(), String> {
        let value = report.number(node)?;
        match term {
            Term::Added(i, j) => self.added[(i, j)] = value,
            Term::Linear(i, j) => self.linear[(i, j)] = value,
            Term::Abs(i, j, k) if j == k => self.quadratic[(i, j)] += value,
            Term::Plain(i, j, k) if i == j && j == k => {
                if value != 0.0 {
                    let long = format!("{0}abs{1}", &name(node)[..2], &name(node)[2..]);
                    report.doubt(
                        node,
                        &format!(
                            "read as <{long}>, as until November 2022; later versions do not reverse it with the speed"
                        ),
                    );
                }
                self.quadratic[(i, j)] += value;
            }
            Term::Plain(i, 0, j) | Term::Plain(i, j, 0) => self.forward[(i, j)] += value,
            Term::Abs(..) | Term::Plain(..) if value == 0.0 => {}
            Term::Abs(..) => {
                return Err(report.fault(node, "products of one speed and the amount of another are not supported"));
            }
            Term::Plain(..) => {
                return Err(report.fault(node, "products of two speeds are supported only if one is U"));
            }
        }
        Ok(())
    }
}

/// The added mass, positive.
fn added_mass(plugin: Node<'_>, m: &Matrix6<f64>, report: &mut Report) -> Result<Matrix6<f64>, String> {
    if let Some(odd) = asymmetric(m) {
        report.doubt(plugin, &format!("added mass is not symmetric in {odd}: read as it stands"));
    }
    let positive = entries(m, |i, j, v| i == j && v > 0.0);
    let negative = entries(m, |i, j, v| i == j && v < 0.0);
    match (positive, negative) {
        (None, _) => Ok(negated(m)),
        (Some(odd), None) => {
            report.doubt(
                plugin,
                &format!(
                    "added mass is positive ({odd}), as until July 2022: read as the mass itself; later versions have \
                     it negative"
                ),
            );
            Ok(*m)
        }
        (Some(some), Some(others)) => {
            Err(report.fault(plugin, &format!("added mass is positive in {some} but negative in {others}")))
        }
    }
}

/// A damping, positive where it resists.
fn damping(plugin: Node<'_>, what: &str, m: &Matrix6<f64>, report: &mut Report) -> Matrix6<f64> {
    if let Some(odd) = entries(m, |i, j, v| i == j && v > 0.0) {
        report.doubt(
            plugin,
            &format!(
                "{what} damping is positive in {odd}: read as gz-sim does, so it drives the body on; what resists is \
                 negative"
            ),
        );
    }
    negated(m)
}
