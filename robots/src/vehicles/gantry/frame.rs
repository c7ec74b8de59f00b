//! Reads a gantry's URDF: two slides found by their structure, masses, collision shapes, probes.
//!
//! *Source:* ROS URDF, XML specification of `robot`, `link` and `joint` (`limit`: lower, upper, velocity, effort).
//!
//! *Parameters:* none.
//!
//! *Deviations:* exactly two joints move. Both are prismatic, one carries the other, and each lies along x or y of
//! the base: x is forward (up-stream), y to the left. The parts are base, first slide, and second slide with the
//! head, each with all links fixed to it. The child link of the second slide's joint is the head, and its origin is
//! the point that is steered. A probe is any link fixed to the head whose name begins with `probe_`; its origin is
//! the tip. Only the slides' own links need mass. `visual`, `dynamics` and `mimic` are not read.

use super::super::urdf_parts::{UrdfText, check_tree, finite, joined, parse, place, pose_of, root, shape};
use super::drive::AxisLimits;
use crate::error::{RobotError, ensure, require};
use crate::handoff::{MAX_PROBES, ProbeMount};
use nalgebra::Vector3;
use urdf_rs::{Joint, JointLimit, JointType, Robot};
use world::frames::Pose;
use world::physics::Shape;

/// Beginning of the names of links that are probes.
const PROBE: &str = "probe_";
/// How far an axis may deviate from x or y of the base: rounding of angles in a file.
const SKEW: f64 = 1e-4;

/// A slide: its joint and what it carries, without the next slide.
#[derive(Clone, Debug)]
pub(super) struct Slide {
    pub(super) joint: String,
    /// 0: along x of the base, 1: along y.
    pub(super) axis: usize,
    /// 1, or -1 if the joint counts in the opposite direction.
    pub(super) sign: f64,
    pub(super) limits: AxisLimits,
    pub(super) mass_kg: f64,
    pub(super) shapes: Vec<(Pose, Shape)>,
}

/// Contents of a gantry's URDF. Places are in base axes with both joints at zero.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) base_shapes: Vec<(Pose, Shape)>,
    pub(super) slides: [Slide; 2],
    pub(super) head_B: Vector3<f64>,
    pub(super) probes: Vec<ProbeMount>,
}

/// Reads the text of a URDF and the mesh files that it names.
pub(super) fn read(urdf: &UrdfText) -> Result<Frame, RobotError> {
    frame(urdf).map_err(|problem| urdf.fault(problem))
}

fn frame(urdf: &UrdfText) -> Result<Frame, String> {
    let robot = parse(&urdf.text)?;
    check_tree(&robot)?;
    let base = root(&robot)?.name.as_str();
    let moving = chain(&robot)?;
    let links = place(&robot, base)?;
    let part = |link: &str| part_of(&robot, &moving, link);
    ensure(part(&moving[1].parent.link) == 1, || {
        format!(
            "joint \"{}\" is not carried by joint \"{}\": the base must carry one slide, and that slide the other",
            moving[1].name, moving[0].name
        )
    })?;
    let slide = |k: usize| -> Result<Slide, String> {
        let joint = moving[k];
        let (axis, sign) = along(joint, &links[&joint.child.link])?;
        Ok(Slide { joint: joint.name.clone(), axis, sign, limits: limits(joint)?, mass_kg: 0.0, shapes: Vec::new() })
    };
    let mut slides = [slide(0)?, slide(1)?];
    ensure(slides[0].axis != slides[1].axis, || {
        format!(
            "joints \"{}\" and \"{}\" are parallel: one must lie along x of \"{base}\", the other along y",
            moving[0].name, moving[1].name
        )
    })?;
    let head = &moving[1].child.link;
    let head_B = links[head].p_WB;
    let mut base_shapes = Vec::new();
    let mut probes = Vec::new();
    for link in &robot.links {
        let (name, on, at) = (&link.name, part(&link.name), &links[&link.name]);
        let mass = link.inertial.mass.value;
        let own = on > 0 && moving[on - 1].child.link == *name;
        if !(mass.is_finite() && (mass > 0.0 || (mass == 0.0 && !own))) {
            let least = if own { "> 0" } else { ">= 0" };
            return Err(format!("link \"{name}\": <mass> must be {least} kg, got {mass}"));
        }
        if on > 0 {
            slides[on - 1].mass_kg += mass;
        }
        for (i, collision) in link.collision.iter().enumerate() {
            let which = format!("link \"{name}\", collision {}", i + 1);
            let solid = shape(&collision.geometry, urdf).map_err(|e| format!("{which}: {e}"))?;
            finite(&collision.origin, &which)?;
            let placed = (joined(at, &pose_of(&collision.origin)), solid);
            match on {
                0 => base_shapes.push(placed),
                k => slides[k - 1].shapes.push(placed),
            }
        }
        if name.starts_with(PROBE) {
            ensure(on == 2, || format!("link \"{name}\" is a probe, but not fixed to the head \"{head}\""))?;
            probes.push(ProbeMount { name: name.clone(), offset_m: at.p_WB - head_B });
        }
    }
    ensure(!probes.is_empty(), || {
        format!("no probe: no link whose name begins with \"{PROBE}\" is fixed to the head \"{head}\"")
    })?;
    ensure(probes.len() <= MAX_PROBES, || format!("{} probes, but at most {MAX_PROBES} are possible", probes.len()))?;
    ensure(!slides[1].shapes.is_empty(), || {
        format!("link \"{head}\" has no <collision>, nor has any link fixed to it: it could not touch anything")
    })?;
    Ok(Frame { base_shapes, slides, head_B, probes })
}

impl Frame {
    /// Takes probes off, and moves the others across so that they span a distance, m.
    ///
    /// # Errors
    /// If there is no such probe, none is left, or the span is asked of probes that are not apart.
    pub(super) fn change_probes(&mut self, without: &[String], span_m: Option<f64>) -> Result<(), RobotError> {
        for (n, name) in without.iter().enumerate() {
            let there = self.probes.iter().position(|p| p.name == *name);
            let all: Vec<&str> = self.probes.iter().map(|p| p.name.as_str()).collect();
            let problem = format!("there is no probe {name:?}; there are: {}", all.join(", "));
            let there = there.ok_or(RobotError::Invalid { field: format!("without[{n}]"), problem })?;
            self.probes.remove(there);
        }
        require(!self.probes.is_empty(), "without", "takes off every probe: leave at least one")?;
        if let Some(span_m) = span_m {
            let y = |p: &ProbeMount| p.offset_m.y;
            let right = self.probes.iter().map(y).fold(f64::MAX, f64::min);
            let left = self.probes.iter().map(y).fold(f64::MIN, f64::max);
            require(left > right, "span_m", "needs two probes that are apart across the stream")?;
            for p in &mut self.probes {
                p.offset_m.y = (p.offset_m.y - 0.5 * (left + right)) * span_m / (left - right) + 0.5 * (left + right);
            }
        }
        Ok(())
    }
}

/// The part to which a link belongs: 0 the base, 1 and 2 the slides.
fn part_of(robot: &Robot, moving: &[&Joint; 2], link: &str) -> usize {
    let mut link = link;
    loop {
        if let Some(k) = moving.iter().position(|j| j.child.link == link) {
            return k + 1;
        }
        match robot.joints.iter().find(|j| j.child.link == link) {
            Some(joint) => link = &joint.parent.link,
            None => return 0,
        }
    }
}

/// The two moving joints, the one nearer to the base first.
fn chain(robot: &Robot) -> Result<[&Joint; 2], String> {
    let mut moving = Vec::new();
    for joint in &robot.joints {
        match joint.joint_type {
            JointType::Fixed => {}
            JointType::Prismatic => moving.push(joint),
            ref other => {
                return Err(format!(
                    "joint \"{}\" is {}, but a gantry's joints are prismatic or fixed",
                    joint.name,
                    format!("{other:?}").to_lowercase()
                ));
            }
        }
    }
    let names: Vec<String> = moving.iter().map(|j| format!("\"{}\"", j.name)).collect();
    let [a, b] = moving[..] else {
        let found = match names.len() {
            0 => "none is".to_string(),
            n => format!("{n} are: {}", names.join(", ")),
        };
        return Err(format!("two joints must be prismatic, one on the base and one on the first; {found}"));
    };
    // If `b` lies between the base and `a`, it comes first.
    let mut link = a.parent.link.as_str();
    while let Some(joint) = robot.joints.iter().find(|j| j.child.link == link) {
        if joint.name == b.name {
            return Ok([b, a]);
        }
        link = &joint.parent.link;
    }
    Ok([a, b])
}

/// Axis of the base along which a joint moves, and its sign.
fn along(joint: &Joint, child_B: &Pose) -> Result<(usize, f64), String> {
    let given = Vector3::from(joint.axis.xyz.0);
    let length = given.norm();
    ensure(length > 0.0 && length.is_finite(), || {
        format!("joint \"{}\": <axis> must have a length > 0, got {} {} {}", joint.name, given.x, given.y, given.z)
    })?;
    let along_B = child_B.R_WB * (given / length);
    for axis in 0..2 {
        if 1.0 - along_B[axis].abs() < SKEW * SKEW {
            return Ok((axis, along_B[axis].signum()));
        }
    }
    Err(format!(
        "joint \"{}\": its axis must lie along x or y of the base, but points to {:.4} {:.4} {:.4} there",
        joint.name, along_B.x, along_B.y, along_B.z
    ))
}

fn limits(joint: &Joint) -> Result<AxisLimits, String> {
    let (name, l) = (&joint.name, &joint.limit);
    ensure(*l != JointLimit::default(), || format!("joint \"{name}\" has no <limit>"))?;
    ensure(l.lower.is_finite() && l.upper.is_finite() && l.lower < l.upper, || {
        format!("joint \"{name}\", limit: lower must be less than upper, got {} and {}", l.lower, l.upper)
    })?;
    for (what, v, unit) in [("velocity", l.velocity, "m/s"), ("effort", l.effort, "N")] {
        ensure(v > 0.0 && v.is_finite(), || format!("joint \"{name}\", limit: {what} must be > 0 {unit}, got {v}"))?;
    }
    Ok(AxisLimits { travel_m: [l.lower, l.upper], speed_m_s: l.velocity, effort_N: l.effort })
}
