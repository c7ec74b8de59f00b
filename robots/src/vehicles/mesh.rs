//! Corner points of STL and OBJ files, for convex hulls.
//!
//! *Source:* 3D Systems, StereoLithography Interface Specification (1989); Wavefront, Advanced
//! Visualizer manual, appendix B1 (OBJ).
//!
//! *Parameters:* none.
//!
//! *Deviations:* only the corners are read: a hull needs no faces.

use nalgebra::Vector3;
use std::path::Path;

/// All corners in a file; the error says what is wrong with it.
pub(super) fn points(path: &Path) -> Result<Vec<Vector3<f64>>, String> {
    let bytes = std::fs::read(path).map_err(|e| e.to_string())?;
    let name = path.to_string_lossy().to_lowercase();
    let points = if name.ends_with(".obj") {
        after_word(&bytes, "v")?
    } else if name.ends_with(".stl") {
        let count = bytes
            .get(80..84)
            .map(|n| u32::from_le_bytes([n[0], n[1], n[2], n[3]]) as usize);
        match count {
            Some(n) if bytes.len() == 84 + 50 * n => binary_stl(&bytes[84..]),
            _ => after_word(&bytes, "vertex")?,
        }
    } else {
        return Err("mesh files end in .stl or .obj".into());
    };
    if points.len() < 4 || points.iter().any(|p| !p.iter().all(|v| v.is_finite())) {
        return Err("needs at least four corners, all finite".into());
    }
    Ok(points)
}

fn after_word(bytes: &[u8], word: &str) -> Result<Vec<Vector3<f64>>, String> {
    let text = std::str::from_utf8(bytes).map_err(|e| e.to_string())?;
    let mut points = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        if words.next() == Some(word) {
            let xyz: Vec<f64> = words.take(3).filter_map(|w| w.parse().ok()).collect();
            if xyz.len() != 3 {
                return Err(format!("line {}: three numbers expected", i + 1));
            }
            points.push(Vector3::from_row_slice(&xyz));
        }
    }
    Ok(points)
}

fn binary_stl(records: &[u8]) -> Vec<Vector3<f64>> {
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    records
        .chunks_exact(50)
        .flat_map(|r| r[12..48].chunks_exact(12))
        .map(|c| Vector3::new(number(c), number(&c[4..]), number(&c[8..])))
        .collect()
}
