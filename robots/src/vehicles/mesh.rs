//! Corner points of STL and OBJ files, for convex hulls.
//!
//! *Source:* the bytes are parsed by [`world::obstacles::mesh_corners`], which names the formats.
//!
//! *Parameters:* none.
//!
//! *Deviations:* only the corners are read: a hull needs no faces.

use super::files::Files;
use nalgebra::Vector3;
use std::path::Path;
use world::obstacles::{LONGEST_MESH_BYTES, mesh_corners};

/// All corners in a file; the error says what is wrong with it and where, but not its path.
pub(super) fn points(name: &Path, files: &dyn Files) -> Result<Vec<Vector3<f64>>, String> {
    let bytes = files.bytes(name, LONGEST_MESH_BYTES)?;
    let corners = mesh_corners(&bytes, name).map_err(|(place, problem)| {
        if place.is_empty() {
            problem
        } else {
            format!("at {}: {problem}", place.trim_start_matches([':', ' ']))
        }
    })?;
    if corners.len() < 4 {
        return Err("needs at least four corners".into());
    }
    Ok(corners.into_iter().map(Vector3::from).collect())
}
