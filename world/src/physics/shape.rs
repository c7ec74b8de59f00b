//! What a body looks like to the contact solver, in plain numbers.

use crate::convert::{pose, vector};
use crate::frames::Pose;
use nalgebra::Vector3;
use rapier3d::geometry::SharedShape;

/// A convex or meshed piece of a body. Long shapes lie along their own z axis, as in URDF.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Ball.
    Sphere {
        /// Radius, m.
        radius_m: f64,
    },
    /// Cylinder with half-spheres at both ends, along z.
    Capsule {
        /// Radius, m.
        radius_m: f64,
        /// Length of the straight part, m.
        length_m: f64,
    },
    /// Cylinder along z.
    Cylinder {
        /// Radius, m.
        radius_m: f64,
        /// Length, m.
        length_m: f64,
    },
    /// Box.
    Box {
        /// Edge lengths, m.
        size_m: Vector3<f64>,
    },
    /// Convex hull of points.
    Hull {
        /// The points, m.
        points_m: Vec<Vector3<f64>>,
    },
}

/// Tells of a point, m, whether it lies in a shape.
pub type Inside = Box<dyn Fn(&Vector3<f64>) -> bool>;

impl Shape {
    /// The shape in the solver's form; `None` if the points of a hull lie in one plane.
    pub(super) fn shared(&self) -> Option<SharedShape> {
        use rapier3d::math::Vector;
        Some(match self {
            Shape::Sphere { radius_m } => SharedShape::ball(*radius_m),
            Shape::Capsule { radius_m, length_m } => {
                let end = Vector::new(0.0, 0.0, length_m / 2.0);
                SharedShape::capsule(-end, end, *radius_m)
            }
            Shape::Cylinder { radius_m, length_m } => {
                // parry's cylinders stand along y.
                let lying = Pose {
                    p_WB: Vector3::zeros(),
                    R_WB: nalgebra::UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2),
                };
                SharedShape::compound(vec![(pose(&lying), SharedShape::cylinder(length_m / 2.0, *radius_m))])
            }
            Shape::Box { size_m } => SharedShape::cuboid(size_m.x / 2.0, size_m.y / 2.0, size_m.z / 2.0),
            Shape::Hull { points_m } => {
                let points: Vec<Vector> = points_m.iter().map(vector).collect();
                SharedShape::convex_hull(&points)?
            }
        })
    }

    /// Whether the solver can use it: false for a hull whose points span no volume.
    pub fn is_solid(&self) -> bool {
        // One cubic millimetre, because a flat hull has some volume from rounding.
        self.shared().is_some_and(|s| s.mass_properties(1.0).mass() > 1e-9)
    }

    /// Tells of points, m in its own axes, whether they lie in it; of a flat hull none does.
    pub fn inside(&self) -> Inside {
        let shared = self.shared();
        Box::new(move |p| shared.as_ref().is_some_and(|s| s.contains_local_point(vector(p))))
    }

    /// Greatest distance of any of its points from its origin, m.
    pub fn reach_m(&self) -> f64 {
        match self {
            Shape::Sphere { radius_m } => *radius_m,
            Shape::Capsule { radius_m, length_m } => length_m / 2.0 + radius_m,
            Shape::Cylinder { radius_m, length_m } => (length_m * length_m / 4.0 + radius_m * radius_m).sqrt(),
            Shape::Box { size_m } => size_m.norm() / 2.0,
            Shape::Hull { points_m } => points_m.iter().map(Vector3::norm).fold(0.0, f64::max),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_lie_along_z_and_reach_covers_them() {
        for shape in [
            Shape::Sphere { radius_m: 0.3 },
            Shape::Capsule { radius_m: 0.1, length_m: 1.0 },
            Shape::Cylinder { radius_m: 0.1, length_m: 1.0 },
            Shape::Box { size_m: Vector3::new(0.1, 0.1, 1.0) },
        ] {
            let s = shape.shared().expect("a solid shape");
            let half = s.compute_local_aabb().half_extents();
            assert!(half.z >= half.x && half.z >= half.y, "{shape:?}");
            assert!(shape.reach_m() >= half.z - 1e-9, "{shape:?}");
            let inside = shape.inside();
            let along = |z| inside(&Vector3::new(0.0, 0.0, z));
            let end = half.z;
            assert!(along(0.99 * end) && !along(1.01 * end), "{shape:?}");
        }
    }

    #[test]
    fn a_flat_hull_is_no_shape() {
        let p = |x, y, z| Vector3::new(x, y, z);
        let corners = [p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, 1.0, 0.0)];
        let hull = |top| Shape::Hull { points_m: corners.iter().copied().chain([top]).collect() };
        assert!(!hull(p(1.0, 1.0, 0.0)).is_solid());
        assert!(hull(p(1.0, 1.0, 1.0)).is_solid());
    }
}
