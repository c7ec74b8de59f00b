//! Corner points of STL and OBJ files, for convex hulls, and their triangles, to look at.
//!
//! *Source:* the bytes are parsed by [`world::obstacles::mesh_corners`] and [`world::obstacles::mesh_triangles`],
//! which name the formats.
//!
//! *Parameters:* none.
//!
//! *Deviations:* of a hull only the corners are read: it needs no faces.

use super::files::Files;
use nalgebra::Vector3;
use std::path::Path;
use world::obstacles::{LONGEST_MESH_BYTES, MeshProblem, mesh_corners, mesh_triangles};

/// All corners in a file; the error says what is wrong with it and where, but not its path.
pub(super) fn points(name: &Path, files: &dyn Files) -> Result<Vec<Vector3<f64>>, String> {
    let bytes = files.bytes(name, LONGEST_MESH_BYTES)?;
    let corners = mesh_corners(&bytes, name).map_err(locate)?;
    if corners.len() < 4 {
        return Err("needs at least four corners".into());
    }
    Ok(corners.into_iter().map(Vector3::from).collect())
}

/// All triangles in a file; the error as that of [`points`].
pub(super) fn triangles(name: &Path, files: &dyn Files) -> Result<Vec<[Vector3<f64>; 3]>, String> {
    let bytes = files.bytes(name, LONGEST_MESH_BYTES)?;
    let all = mesh_triangles(&bytes, name).map_err(locate)?;
    Ok(all.into_iter().map(|t| t.map(Vector3::from)).collect())
}

fn locate((place, problem): MeshProblem) -> String {
    if place.is_empty() { problem } else { format!("at {}: {problem}", place.trim_start_matches([':', ' '])) }
}
