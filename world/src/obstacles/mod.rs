//! Solid things standing in the water: boxes, cylinders, height fields and closed meshes.

mod cast;
mod heightfield_file;
mod mesh;
mod mesh_file;
mod outline;
mod placing;
mod solid;
mod spec;
mod surface;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_placing;
mod triangles;
mod way_out;

pub use cast::Hit;
pub use mesh_file::{LONGEST_MESH_BYTES, MeshProblem, mesh_corners, mesh_triangles};
pub use placing::Remark;
pub use solid::{Obstacle, Obstacles};
pub use spec::{Base, BoxShape, CylinderShape, HeightfieldShape, MeshShape, ObstacleSpec, ShapeSpec};
pub use surface::Surface;
