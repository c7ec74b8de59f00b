//! Solid things standing in the water: boxes, cylinders and closed meshes.

mod mesh;
mod mesh_file;
mod outline;
mod solid;
mod spec;
#[cfg(test)]
mod tests;
mod way_out;

pub use solid::{Obstacle, Obstacles};
pub use spec::{Base, BoxShape, CylinderShape, MeshShape, ObstacleSpec, ShapeSpec};
