//! Makes a closed, outward-facing surface from loose triangles, so that "inside" has a meaning.
//!
//! *Source:* signed distance by angle-weighted pseudo-normals needs a closed oriented surface: Bærentzen and Aanæs
//! 2005, IEEE TVCG 11, section 3.
//!
//! *Parameters:* none; corners with exactly equal coordinates are one vertex.
//!
//! *Deviations:* a surface that is inside out is reversed; one with holes is refused, not mended.

use super::mesh_file::Triangle;
use crate::error::WorldError;
use parry3d::math::Vector;
use parry3d::shape::{TriMesh, TriMeshFlags};
use std::collections::BTreeMap;
use std::path::Path;

/// No obstacle reaches farther from its own origin, m. A larger value means a wrong unit or a corrupt number.
const FARTHEST_M: f64 = 1e5;

/// Builds the surface, with vertices scaled to metres.
pub(super) fn closed(triangles: &[Triangle], scale: f64, path: &Path) -> Result<TriMesh, WorldError> {
    let fail = |place: String, problem: String| WorldError::File { path: path.display().to_string(), place, problem };
    let far = |t: &Triangle| t.as_flattened().iter().any(|v| v.abs() * scale > FARTHEST_M);
    if let Some(n) = triangles.iter().position(far) {
        let problem = format!(
            "a corner is farther than {FARTHEST_M} m from the origin: give scale, metres in one unit of the file"
        );
        return Err(fail(format!(": triangle {}", n + 1), problem));
    }
    let mut index_of = BTreeMap::new();
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for t in triangles {
        let face = t.map(|c| {
            // Adding zero makes -0.0 the same key as 0.0.
            let key = c.map(|v| (v + 0.0).to_bits());
            *index_of.entry(key).or_insert_with(|| {
                vertices.push(Vector::new(c[0] * scale, c[1] * scale, c[2] * scale));
                vertices.len() as u32 - 1
            })
        });
        let [a, b, c] = face;
        // Slivers with two equal corners carry no surface.
        if a != b && b != c && c != a {
            faces.push(face);
        }
    }
    let mut edges = BTreeMap::new();
    for (n, f) in faces.iter().enumerate() {
        for (a, b) in [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])] {
            if edges.insert((a, b), n).is_some() {
                let problem = "an edge is used twice in the same direction: faces overlap or point in different ways";
                return Err(fail(place(&vertices, scale, a, b), problem.into()));
            }
        }
    }
    if let Some((a, b)) = edges.keys().find(|(a, b)| !edges.contains_key(&(*b, *a))) {
        let problem = "the surface is not closed here: an obstacle needs an inside";
        return Err(fail(place(&vertices, scale, *a, *b), problem.into()));
    }
    let volume = volume_m3(&vertices, &faces);
    if volume == 0.0 {
        let problem = "the surface encloses no volume: an obstacle needs an inside";
        return Err(fail(String::new(), problem.into()));
    }
    if volume < 0.0 {
        for f in &mut faces {
            f.swap(1, 2);
        }
    }
    let flags = TriMeshFlags::ORIENTED | TriMeshFlags::FIX_INTERNAL_EDGES;
    TriMesh::with_flags(vertices, faces, flags).map_err(|e| fail(String::new(), e.to_string()))
}

fn place(vertices: &[Vector], scale: f64, a: u32, b: u32) -> String {
    let [p, q] = [a, b].map(|i| vertices[i as usize] / scale);
    format!(": edge ({} {} {}) - ({} {} {})", p.x, p.y, p.z, q.x, q.y, q.z)
}

fn volume_m3(vertices: &[Vector], faces: &[[u32; 3]]) -> f64 {
    let six: f64 = faces.iter().map(|f| f.map(|i| vertices[i as usize])).map(|[a, b, c]| a.dot(b.cross(c))).sum();
    six / 6.0
}
