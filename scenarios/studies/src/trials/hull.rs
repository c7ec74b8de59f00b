//! A vehicle's hull from the side and from above, with its drives and where its forces act.

use nalgebra::{UnitQuaternion, Vector3};
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::panel::Panel;
use world::frames::Pose;
use world::physics::Shape;

/// What is drawn of a vehicle; all in body axes (FLU), m.
#[derive(Clone, Debug)]
pub struct Looks {
    /// Name.
    pub name: String,
    /// Shapes to look at, with their colours (`#rrggbb`).
    pub shapes: Vec<(Pose, Shape, String)>,
    /// Centres of gravity and of buoyancy.
    pub centres: [Vector3<f64>; 2],
    /// Where each drive sits, the direction in which it pushes or lifts, and its number.
    pub drives: Vec<(Vector3<f64>, Vector3<f64>, usize)>,
}

/// Pixels of a view.
const SIDES: [f64; 2] = [460.0, 320.0];

/// The drawing, as SVG text.
pub fn drawn(looks: &Looks) -> String {
    let mut c = Canvas::new(2.0 * SIDES[0] + 150.0, SIDES[1] + 130.0);
    c.bold([20.0, 28.0], 16.0, Anchor::Start, &looks.name);
    let outlines: Vec<(Vec<Vector3<f64>>, &str)> = looks
        .shapes
        .iter()
        .map(|(pose, shape, colour)| {
            let points = corners(shape).into_iter().map(|p| pose.point(p)).collect();
            (points, colour.as_str())
        })
        .collect();
    let points = || outlines.iter().flat_map(|(points, _)| points).chain(looks.drives.iter().map(|d| &d.0));
    let across = |p: &Vector3<f64>| p.y.abs().max(p.z.abs()) * SIDES[0] / SIDES[1];
    let reach = points().map(|p| p.x.abs().max(across(p))).fold(0.1, f64::max);
    // From the side one looks to port: x to the right, z up. From above: x to the right, y up.
    for (k, (title, axes)) in [("from starboard", [0, 2]), ("from above", [0, 1])].into_iter().enumerate() {
        let panel = Panel {
            left: 60.0 + (SIDES[0] + 60.0) * k as f64,
            top: 70.0,
            width: SIDES[0],
            height: SIDES[1],
            x: [-1.2 * reach, 1.2 * reach],
            y: [-1.2 * reach * SIDES[1] / SIDES[0], 1.2 * reach * SIDES[1] / SIDES[0]],
        };
        view(&mut c, &panel, title, axes, &outlines, looks);
    }
    c.text(
        [60.0, SIDES[1] + 110.0],
        11.0,
        Anchor::Start,
        "in m; G centre of gravity, B centre of buoyancy; arrows: where a positive set-point pushes or lifts",
    );
    c.svg("hull")
}

fn view(
    c: &mut Canvas,
    panel: &Panel,
    title: &str,
    axes: [usize; 2],
    outlines: &[(Vec<Vector3<f64>>, &str)],
    looks: &Looks,
) {
    let flat = |p: &Vector3<f64>| panel.position([p[axes[0]], p[axes[1]]]);
    panel.grid(c, 45.0);
    panel.axes(c, 45.0, 11.0);
    c.bold([panel.left, panel.top - 10.0], 13.0, Anchor::Start, title);
    panel.clip(c);
    // What is farther from the eye is drawn first.
    let depth = |points: &[Vector3<f64>]| {
        let axis = 3 - axes[0] - axes[1];
        let sum: f64 = points.iter().map(|p| p[axis]).sum();
        let towards = if axis == 1 { -1.0 } else { 1.0 };
        towards * sum / points.len().max(1) as f64
    };
    let mut order: Vec<&(Vec<Vector3<f64>>, &str)> = outlines.iter().collect();
    order.sort_by(|a, b| depth(&a.0).total_cmp(&depth(&b.0)));
    for (points, colour) in order {
        let around = hull_of(points.iter().map(flat).collect());
        c.polygon(around, &Style::fill(colour).edged("#444444", 0.8).faint(0.85));
    }
    for (at, way, n) in &looks.drives {
        let start = flat(at);
        let end = flat(&(at + way * 0.25 * panel.x[1]));
        let long = nalgebra::Vector2::new(end[0] - start[0], end[1] - start[1]).norm();
        if long > 3.0 {
            c.arrow(start, end, "#b3541e", 2.0);
        } else {
            c.circle(start, 4.0, &Style::line("#b3541e", 2.0));
        }
        c.rimmed([end[0] + 5.0, end[1] - 5.0], 11.0, Anchor::Start, &format!("{n}"));
    }
    for (centre, name, colour) in [(&looks.centres[0], "G", "#111111"), (&looks.centres[1], "B", "#1f5fa8")] {
        let at = flat(centre);
        c.circle(at, 3.5, &Style::fill(colour).edged("#ffffff", 1.0));
        let y = if name == "B" { at[1] - 6.0 } else { at[1] + 14.0 };
        c.rimmed([at[0] - 12.0, y], 12.0, Anchor::Start, name);
    }
    c.unclip();
}

/// Points whose convex hull is the shape.
fn corners(shape: &Shape) -> Vec<Vector3<f64>> {
    let ring = |r: f64, z: f64| {
        (0..24).map(move |k| {
            let (sin, cos) = world::math::sin_cos(f64::from(k) * std::f64::consts::TAU / 24.0);
            Vector3::new(r * cos, r * sin, z)
        })
    };
    let ball = |r: f64, z: f64| {
        let turns = (0..12).map(move |k| {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), f64::from(k) * std::f64::consts::PI / 12.0)
        });
        turns.flat_map(move |turn| ring(r, 0.0).map(move |p| turn * p + Vector3::z() * z))
    };
    match shape {
        Shape::Sphere { radius_m } => ball(*radius_m, 0.0).collect(),
        Shape::Capsule { radius_m, length_m } => {
            ball(*radius_m, -length_m / 2.0).chain(ball(*radius_m, length_m / 2.0)).collect()
        }
        Shape::Cylinder { radius_m, length_m } => {
            ring(*radius_m, -length_m / 2.0).chain(ring(*radius_m, length_m / 2.0)).collect()
        }
        Shape::Box { size_m } => (0..8)
            .map(|k| {
                let side = |bit: u32| if k & bit == 0 { -0.5 } else { 0.5 };
                Vector3::new(side(1), side(2), side(4)).component_mul(size_m)
            })
            .collect(),
        Shape::Hull { points_m } => points_m.clone(),
    }
}

/// Convex hull of points of the sheet, in order (Andrew's monotone chain).
fn hull_of(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turn = |a: &[f64; 2], b: &[f64; 2], p: &[f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let half = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while chain.len() > 1 && turn(&chain[chain.len() - 2], &chain[chain.len() - 1], p) <= 0.0 {
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let mut around = half(&mut points.iter());
    around.extend(half(&mut points.iter().rev()));
    around
}
