//! Corner points of STL and OBJ files, for convex hulls.
//!
//! *Source:* the files are read by [`world::obstacles::read_corners`], which names their formats.
//!
//! *Parameters:* none.
//!
//! *Deviations:* only the corners are read: a hull needs no faces.

use nalgebra::Vector3;
use std::path::Path;
use world::error::WorldError;
use world::obstacles::read_corners;

/// All corners in a file; the error says what is wrong with it and where, but not its path.
pub(super) fn points(path: &Path) -> Result<Vec<Vector3<f64>>, String> {
    let corners = read_corners(path).map_err(|e| match e {
        WorldError::File { place, problem, .. } if place.is_empty() => problem,
        WorldError::File { place, problem, .. } => {
            format!("at {}: {problem}", place.trim_start_matches([':', ' ']))
        }
        other => other.to_string(),
    })?;
    if corners.len() < 4 {
        return Err("needs at least four corners".into());
    }
    Ok(corners.into_iter().map(Vector3::from).collect())
}
