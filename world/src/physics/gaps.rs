//! How far two solids are from each other, and the points where they touch.
//!
//! *Source:* parry's closest points (GJK; EPA where solids overlap) and contact manifolds, as in rapier's narrow phase.
//!
//! *Parameters:* none.
//!
//! *Deviations:* a surface that encloses nothing (bed, mesh) is met from both sides. GJK loses curved surfaces that
//! just touch, so distances of a capsule are measured from its axis, and a body with edges has a skin of 1 mm.

use crate::convert::from_vector;
use nalgebra::Vector3;
use rapier3d::math as r;
use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::parry::query::{self, ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher};
use rapier3d::parry::shape::SharedShape;

/// Thickness of the skin of a body with edges, m: distances near zero are unreliable.
const SKIN_M: f64 = 1e-3;

/// A point where two solids are next to each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Point between the two surfaces, world axes, m.
    pub(super) at_W: Vector3<f64>,
    /// Unit normal towards the first solid.
    pub(super) normal_W: Vector3<f64>,
    /// Distance, m; negative where they overlap.
    pub(super) gap_m: f64,
}

impl Point {
    /// Where an axis lies in a face, or where two axes cross, there is no direction between the surfaces: such a solid
    /// is pushed up. `None` if parry finds no number at all, as for a triangle without area.
    fn new(on_W: [r::Vector; 2], normal_W: Vector3<f64>, gap_m: f64) -> Option<Self> {
        let at_W = from_vector((on_W[0] + on_W[1]) * 0.5);
        let unit = (normal_W.norm() - 1.0).abs() < 1e-3;
        let normal_W = if unit { normal_W } else { Vector3::z() };
        let known = at_W.iter().all(|x| x.is_finite()) && gap_m.is_finite();
        known.then_some(Self { at_W, normal_W, gap_m })
    }
}

/// A shape at its place.
#[derive(Clone)]
pub(super) struct PlacedShape {
    pose: r::Pose,
    shape: SharedShape,
    /// The shape from which distances are measured, and the distance of the surface from it, m.
    core: SharedShape,
    margin_m: f64,
    /// Distance of its surface from `shape`, m.
    skin_m: f64,
    bounds: Aabb,
}

impl PlacedShape {
    /// Something fixed, or a part of a gantry.
    pub(super) fn new(pose: r::Pose, shape: &SharedShape) -> Self {
        Self {
            pose,
            shape: shape.clone(),
            core: shape.clone(),
            margin_m: 0.0,
            skin_m: 0.0,
            bounds: shape.compute_aabb(&pose),
        }
    }

    /// A part of a body. It never comes nearer to anything than its margin, where distances are reliable.
    pub(super) fn body(pose: r::Pose, shape: &SharedShape) -> Self {
        let plain = Self::new(pose, shape);
        if let Some(capsule) = shape.as_capsule() {
            let axis = capsule.segment;
            Self { core: SharedShape::segment(axis.a, axis.b), margin_m: capsule.radius, ..plain }
        } else if shape.as_ball().is_some() {
            plain
        } else {
            Self { margin_m: SKIN_M, skin_m: SKIN_M, bounds: plain.bounds.loosened(SKIN_M), ..plain }
        }
    }

    /// Its bounds along the first axis, m.
    pub(super) fn along_x(&self) -> [f64; 2] {
        [self.bounds.mins.x, self.bounds.maxs.x]
    }

    /// The nearest point, if it is within `reach_m`.
    pub(super) fn nearest(&self, other: &PlacedShape, reach_m: f64) -> Option<Point> {
        if !self.bounds.loosened(reach_m).intersects(&other.bounds) {
            return None;
        }
        let (a, b) = (self.core.as_ref(), other.core.as_ref());
        let margin_m = self.margin_m + other.margin_m;
        let found = query::contact(&self.pose, a, &other.pose, b, reach_m + margin_m)
            .expect("parry knows the distance between any shapes that it can collide")?;
        let on = [found.point1 + found.normal1 * self.margin_m, found.point2 - found.normal1 * other.margin_m];
        let gap_m = found.dist - margin_m;
        Point::new(on, from_vector(-found.normal1), gap_m)
    }

    /// All points within `reach_m`, including `nearest`.
    pub(super) fn points(&self, other: &PlacedShape, nearest: Point, reach_m: f64) -> Vec<Point> {
        let skin_m = self.skin_m + other.skin_m;
        let mut manifolds: Vec<ContactManifold<(), ()>> = Vec::new();
        DefaultQueryDispatcher
            .contact_manifolds(
                &self.pose.inv_mul(&other.pose),
                self.shape.as_ref(),
                other.shape.as_ref(),
                reach_m + skin_m,
                &mut manifolds,
                &mut None,
            )
            .expect("parry can touch any shapes that it can collide");
        let mut points = Vec::new();
        for manifold in &manifolds {
            let part = |p: Option<&r::Pose>| p.copied().unwrap_or(r::Pose::IDENTITY);
            let first = self.pose * part(manifold.subshape_pos1());
            let second = other.pose * part(manifold.subshape_pos2());
            let normal_W = from_vector(-(first.rotation * manifold.local_n1));
            for point in manifold.points.iter().filter(|p| p.dist <= reach_m + skin_m) {
                let on = [first.transform_point(point.local_p1), second.transform_point(point.local_p2)];
                points.extend(Point::new(on, normal_W, point.dist - skin_m));
            }
        }
        // Manifolds of meshes leave out what they consider an inner edge; the nearest point is always kept.
        let least = points.iter().map(|p| p.gap_m).fold(f64::INFINITY, f64::min);
        if least > nearest.gap_m + 1e-4 {
            points.push(nearest);
        }
        points
    }
}
