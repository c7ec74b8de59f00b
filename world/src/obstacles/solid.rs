//! An obstacle as a solid: whether a point is inside, how far away it is, and where a ray hits it.
//!
//! *Source:* parry3d's shapes and queries; the same shape is the body's collider.
//!
//! *Parameters:* those of [`ObstacleSpec`].
//!
//! *Deviations:* parry's cylinder stands along its own y axis, so the pose of a cylinder turns y up.

use super::{Base, ObstacleSpec, ShapeSpec, Surface, heightfield_file, mesh, mesh_file};
use crate::convert::{from_vector, pose, vector};
use crate::error::WorldError;
use crate::frames::Pose;
use crate::terrain::Terrain;
use bevy_ecs::prelude::Resource;
use nalgebra::{UnitQuaternion, Vector3};
use parry3d::math::Vector;
use parry3d::query::{Ray, intersection_test};
use parry3d::shape::{Cuboid, SharedShape};
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// A solid standing in the water.
#[derive(Clone)]
pub struct Obstacle {
    /// Name in the scenario.
    pub id: String,
    /// Pose of the shape's own axes in the world.
    pub pose: Pose,
    /// The shape, in its own axes.
    pub shape: SharedShape,
    /// How its surface looks and sounds.
    pub surface: Surface,
}

impl std::fmt::Debug for Obstacle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Obstacle").field("id", &self.id).field("pose", &self.pose).finish_non_exhaustive()
    }
}

impl Obstacle {
    /// Builds an obstacle; mesh files are searched in `base_dir`.
    ///
    /// # Errors
    /// If a mesh file is missing, corrupt or does not enclose a volume.
    pub fn build(spec: &ObstacleSpec, terrain: &Terrain, base_dir: &Path) -> Result<Self, WorldError> {
        let yaw = UnitQuaternion::from_euler_angles(0.0, 0.0, spec.heading_deg.heading().yaw());
        let mut foot_m = 0.0;
        let (shape, R_WB) = match &spec.shape {
            ShapeSpec::Box(b) => {
                let (x, y, z) = b.size_m;
                let half = [x, y, z].map(|v| v.get() / 2.0);
                (SharedShape::cuboid(half[0], half[1], half[2]), yaw)
            }
            ShapeSpec::Cylinder(c) => {
                let upright = UnitQuaternion::from_euler_angles(FRAC_PI_2, 0.0, 0.0);
                (SharedShape::cylinder(c.height_m.get() / 2.0, c.radius_m.get()), yaw * upright)
            }
            ShapeSpec::Mesh(m) => {
                let path = base_dir.join(&m.file);
                let triangles = mesh_file::read(&path)?;
                (SharedShape::new(mesh::closed(&triangles, m.scale.get(), &path)?), yaw)
            }
            ShapeSpec::Heightfield(h) => {
                let path = base_dir.join(&h.file);
                let triangles = heightfield_file::read(&path)?.triangles();
                // Its rim is no part of what stands on the bed.
                foot_m = heightfield_file::SKIRT_M * h.scale.get();
                (SharedShape::new(mesh::closed(&triangles, h.scale.get(), &path)?), yaw)
            }
        };
        let (east, north) = (spec.east_m.get(), spec.north_m.get());
        let mut built = Self {
            id: spec.id.clone(),
            pose: Pose { p_WB: Vector3::new(east, north, 0.0), R_WB },
            shape,
            surface: spec.surface.clone(),
        };
        let (min, max) = built.bounds();
        let base_z = match spec.base {
            Base::OnBed => [(east, north), (min.x, min.y), (min.x, max.y), (max.x, min.y), (max.x, max.y)]
                .map(|(x, y)| terrain.bed_z(x, y))
                .into_iter()
                .fold(f64::INFINITY, f64::min),
            Base::Depth(d) => -d.get(),
            Base::Z(z) => z.get(),
        };
        built.pose.p_WB.z = base_z - min.z - foot_m;
        Ok(built)
    }

    /// Whether a point (ENU, m) lies inside.
    pub fn contains(&self, p: &Vector3<f64>) -> bool {
        self.distance(p) < 0.0
    }

    /// Distance from a point (ENU, m) to the surface, m; negative inside.
    pub fn distance(&self, p: &Vector3<f64>) -> f64 {
        let p = vector(p);
        let on = self.shape.project_point(&pose(&self.pose), p, false);
        let d = (on.point - p).length();
        if on.is_inside { -d } else { d }
    }

    /// Axis-aligned bounds (min, max) in the world, m.
    pub fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        let b = self.shape.compute_aabb(&pose(&self.pose));
        (from_vector(b.mins), from_vector(b.maxs))
    }

    /// Its least and its greatest horizontal extent along its own axes, m.
    pub fn plan_m(&self) -> [f64; 2] {
        let half = from_vector(self.shape.compute_local_aabb().half_extents());
        let upright = |axis: usize| (self.pose.R_WB * Vector3::ith(axis, 1.0)).z.abs() > 0.5;
        let flat = (0..3).filter(|axis| !upright(*axis)).map(|axis| 2.0 * half[axis]);
        flat.fold([f64::INFINITY, 0.0], |[least, most], m| [least.min(m), most.max(m)])
    }

    /// Distance along a ray from `origin` (ENU, m) in direction `dir` (any length but zero) to the first hit within
    /// `max_m`, m; zero if it starts inside.
    pub fn ray(&self, origin: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> Option<f64> {
        if self.contains(origin) {
            return Some(0.0);
        }
        let ray = Ray::new(vector(origin), vector(&dir.normalize()));
        self.shape.cast_ray(&pose(&self.pose), &ray, max_m, true)
    }

    /// Whether a block of half extents `half_m` overlaps the obstacle's surface, or its inside if the shape is solid. A
    /// block that only touches does not count.
    pub fn meets_box(&self, pose_WB: &Pose, half_m: [f64; 3]) -> bool {
        let block = Cuboid::new(Vector::new(half_m[0], half_m[1], half_m[2]));
        let at = pose(pose_WB);
        intersection_test(&pose(&self.pose), &*self.shape, &at, &block)
            .expect("parry can intersect a block with any shape that an obstacle has")
            .intersecting
    }
}

/// All solids of a scenario, in its order.
#[derive(Resource, Clone, Debug, Default)]
pub struct Obstacles(pub Vec<Obstacle>);

impl Obstacles {
    /// The obstacle that contains a point, if any.
    pub fn containing(&self, p: &Vector3<f64>) -> Option<&Obstacle> {
        self.0.iter().find(|o| o.contains(p))
    }

    /// Distance to the nearest surface, m (negative inside); infinite without obstacles.
    pub fn distance(&self, p: &Vector3<f64>) -> f64 {
        self.0.iter().map(|o| o.distance(p)).fold(f64::INFINITY, f64::min)
    }

    /// Distance along a ray to the first hit on any obstacle, m; see [`Obstacle::ray`].
    pub fn ray(&self, origin: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> Option<f64> {
        self.0.iter().filter_map(|o| o.ray(origin, dir, max_m)).min_by(f64::total_cmp)
    }
}
