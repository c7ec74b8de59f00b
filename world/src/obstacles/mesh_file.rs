//! Triangles from STL (binary and ASCII) and OBJ files.
//!
//! *Source:* 3D Systems, StereoLithography Interface Specification (1989); Wavefront, Advanced
//! Visualizer manual, appendix B1 (OBJ).
//!
//! *Parameters:* none.
//!
//! *Deviations:* normals, colours, texture coordinates and groups are not read; faces of more than
//! three corners are cut into a fan.

use crate::encoding::unmarked;
use crate::error::WorldError;
use crate::files;
use std::path::Path;

/// A triangle's corners, in units of the file.
pub(super) type Triangle = [[f64; 3]; 3];

/// Reads the triangles of an STL or OBJ file; its ending determines the format.
///
/// # Errors
/// If the file is missing, broken, empty, or larger than can be used.
pub(super) fn read(path: &Path) -> Result<Vec<Triangle>, WorldError> {
    let fail = |(place, problem)| WorldError::File { path: path.display().to_string(), place, problem };
    let read = files::read(path, LONGEST_MESH_BYTES);
    let bytes = read.map_err(|e| fail((String::new(), e.to_string())))?;
    parse(&bytes, &ending(path)).map_err(fail)
}

/// The ending of a file's name, in small letters; it determines the format.
fn ending(name: &Path) -> String {
    let ending = name.extension().unwrap_or_default().to_string_lossy();
    ending.to_lowercase()
}

/// Only the corners in the content of a file, for a hull that needs no faces: all vertices of an OBJ file, used or not,
/// or the three corners of each triangle of an STL file. The ending of `name` determines the format.
///
/// # Errors
/// If the content is broken or empty: the place in the file and the problem.
pub fn mesh_corners(bytes: &[u8], name: &Path) -> Result<Vec<[f64; 3]>, MeshProblem> {
    corners(bytes, &ending(name))
}

/// The triangles in the content of a file, each with its corners in units of the file. The ending of `name` determines
/// the format.
///
/// # Errors
/// If the content is broken, empty or too large: the place in the file and the problem.
pub fn mesh_triangles(bytes: &[u8], name: &Path) -> Result<Vec<[[f64; 3]; 3]>, MeshProblem> {
    parse(bytes, &ending(name))
}

fn corners(bytes: &[u8], ending: &str) -> Result<Vec<[f64; 3]>, MeshProblem> {
    let bytes = unmarked(bytes);
    if ending != "obj" {
        return Ok(parse(bytes, ending)?.into_iter().flatten().collect());
    }
    let text = String::from_utf8_lossy(bytes);
    let mut points = Vec::new();
    for (n, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        if words.next() == Some("v") {
            points.push(numbers(words, &format!(":{}", n + 1))?);
        }
    }
    if points.is_empty() {
        return Err((String::new(), "holds no vertex".into()));
    }
    Ok(points)
}

fn parse(bytes: &[u8], ending: &str) -> Result<Vec<Triangle>, MeshProblem> {
    let bytes = unmarked(bytes);
    let triangles = match ending {
        "stl" if is_ascii_stl(bytes) => ascii_stl(bytes)?,
        "stl" => binary_stl(bytes)?,
        "obj" => obj(bytes)?,
        other => {
            let problem = format!("mesh files end in .stl or .obj, not \".{other}\"");
            return Err((String::new(), problem));
        }
    };
    if triangles.is_empty() {
        return Err((String::new(), "holds no triangle".into()));
    }
    if triangles.len() > MOST {
        let problem = format!("{} triangles are more than {MOST}: simplify the surface", triangles.len());
        return Err((String::new(), problem));
    }
    Ok(triangles)
}

/// The place in a file, beginning with a colon (":12", ": triangle 3") or empty for the file as a whole, and what is
/// wrong there.
pub type MeshProblem = (String, String);

/// Most triangles of a surface: with all that is built from them, they take half a gigabyte.
const MOST: usize = 2_000_000;
/// Longest file read, bytes: enough for that many triangles as text.
pub const LONGEST_MESH_BYTES: u64 = 512 << 20;
const HEADER: usize = 84;
const RECORD: usize = 50;

/// Some binary files also begin with "solid", but only binary files contain zero bytes.
fn is_ascii_stl(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"solid") && !bytes.contains(&0)
}

fn binary_length(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER)?.try_into().ok()?;
    Some(HEADER + RECORD * u32::from_le_bytes(count) as usize)
}

fn binary_stl(bytes: &[u8]) -> Result<Vec<Triangle>, MeshProblem> {
    let whole = binary_length(bytes)
        .ok_or((String::new(), format!("cut short: {} bytes, an STL header has {HEADER}", bytes.len())))?;
    if bytes.len() < whole {
        let problem = format!("cut short: {} bytes, {whole} announced in the header", bytes.len());
        return Err((format!(": triangle {}", (bytes.len() - HEADER) / RECORD + 1), problem));
    }
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let corner = |r: &[u8], at: usize| [0, 4, 8].map(|k| number(&r[at + k..]));
    let records = bytes[HEADER..whole].chunks_exact(RECORD);
    let triangles: Vec<Triangle> = records.map(|r| [12, 24, 36].map(|at| corner(r, at))).collect();
    let broken = |t: &Triangle| !t.as_flattened().iter().all(|v| v.is_finite());
    if let Some(n) = triangles.iter().position(broken) {
        let problem = "a coordinate is not a finite number".to_owned();
        return Err((format!(": triangle {}", n + 1), problem));
    }
    Ok(triangles)
}

fn ascii_stl(bytes: &[u8]) -> Result<Vec<Triangle>, MeshProblem> {
    let text = String::from_utf8_lossy(bytes);
    let (mut triangles, mut corners, mut ended) = (Vec::new(), Vec::new(), false);
    for (n, line) in text.lines().enumerate() {
        let here = format!(":{}", n + 1);
        let mut words = line.split_whitespace();
        match words.next() {
            Some("vertex") => corners.push(numbers(words, &here)?),
            Some("endfacet") => {
                let t = corners.as_slice().try_into().map_err(|_| {
                    let problem = format!("a facet has 3 vertices, not {}", corners.len());
                    (here, problem)
                })?;
                triangles.push(t);
                corners.clear();
            }
            Some("endsolid") => ended = true,
            _ => {}
        }
    }
    if ended && corners.is_empty() {
        return Ok(triangles);
    }
    let place = format!(":{}", text.lines().count());
    Err((place, "cut short: no \"endsolid\" at the end".into()))
}

fn obj(bytes: &[u8]) -> Result<Vec<Triangle>, MeshProblem> {
    let text = String::from_utf8_lossy(bytes);
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for (n, line) in text.lines().enumerate() {
        let here = format!(":{}", n + 1);
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => points.push(numbers(words, &here)?),
            Some("f") => {
                let face = words
                    .map(|w| corner_of(w, &points).map_err(|p| (here.clone(), p)))
                    .collect::<Result<Vec<_>, _>>()?;
                if face.len() < 3 {
                    let problem = format!("a face has at least 3 corners, not {}", face.len());
                    return Err((here, problem));
                }
                triangles.extend((2..face.len()).map(|k| [face[0], face[k - 1], face[k]]));
            }
            _ => {}
        }
    }
    Ok(triangles)
}

/// The vertex that `7`, `7/1/2` or `-1` (the latest) means.
fn corner_of(word: &str, points: &[[f64; 3]]) -> Result<[f64; 3], String> {
    let first = word.split('/').next().unwrap_or_default();
    let index: i64 = first.parse().map_err(|_| format!("\"{word}\" is not a vertex number"))?;
    let count = points.len() as i64;
    let at = if index < 0 { count + index } else { index - 1 };
    usize::try_from(at)
        .ok()
        .and_then(|i| points.get(i).copied())
        .ok_or(format!("vertex {index} of {count} does not exist (yet)"))
}

fn numbers<'a>(words: impl Iterator<Item = &'a str>, here: &str) -> Result<[f64; 3], MeshProblem> {
    let mut v = [0.0; 3];
    let mut words = words;
    for slot in &mut v {
        let word = words.next().ok_or_else(|| {
            let problem = "a vertex has 3 coordinates; the line is cut short".to_owned();
            (here.to_owned(), problem)
        })?;
        *slot = match word.parse::<f64>() {
            Ok(x) if x.is_finite() => x,
            _ => {
                let problem = format!("coordinate \"{word}\" is not a finite number");
                return Err((here.to_owned(), problem));
            }
        };
    }
    Ok(v)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACET: &str = "solid t
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1e0 0.5
endloop
endfacet
";

    fn binary(corners: &[[f32; 3]; 3]) -> Vec<u8> {
        let mut b = b"solid, but binary".to_vec();
        b.resize(80, 0);
        b.extend(1_u32.to_le_bytes());
        b.extend([0; 12]);
        for v in corners.as_flattened() {
            b.extend(v.to_le_bytes());
        }
        b.extend([0; 2]);
        b
    }

    fn wrong(bytes: &[u8], ending: &str) -> String {
        let (place, problem) = parse(bytes, ending).expect_err("a broken file");
        format!("{place}: {problem}")
    }

    #[test]
    fn the_same_triangle_in_each_format() {
        let want = vec![[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]]];
        let ascii = format!("{FACET}endsolid t\n");
        assert_eq!(parse(ascii.as_bytes(), "stl").unwrap(), want);
        let b = binary(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]]);
        assert_eq!(parse(&b, "stl").unwrap(), want);
        let o = "# made by hand\nv 0 0 0\nv 1 0 0\nvn 0 0 1\nv 0 1 0.5\nf 1//1 2/7/1 -1\n";
        assert_eq!(parse(o.as_bytes(), "obj").unwrap(), want);
    }

    #[test]
    fn faces_of_four_corners_become_two_triangles() {
        let o = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
        let got = parse(o.as_bytes(), "obj").unwrap();
        assert_eq!(got.len(), 2);
        assert_eq!(got[1], [[0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    }

    #[test]
    fn corners_need_no_faces() {
        let o = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        assert_eq!(corners(o.as_bytes(), "obj").unwrap().len(), 3);
        let ascii = format!("{FACET}endsolid t\n");
        assert_eq!(corners(ascii.as_bytes(), "stl").unwrap()[2], [0.0, 1.0, 0.5]);
        let says = corners(b"", "obj").expect_err("an empty file").1;
        assert_eq!(says, "holds no vertex");
    }

    #[test]
    fn broken_files_say_where() {
        let at = |text: &str, ending| wrong(text.as_bytes(), ending);
        assert_eq!(at(FACET, "stl"), ":8: cut short: no \"endsolid\" at the end");
        assert_eq!(at(&FACET.replace("1e0", "nan"), "stl"), ":6: coordinate \"nan\" is not a finite number");
        assert_eq!(at(&FACET.replace("vertex 0 0 0\n", ""), "stl"), ":7: a facet has 3 vertices, not 2");
        assert_eq!(at("solid t\nendsolid t\n", "stl"), ": holds no triangle");
        assert_eq!(at("", "obj"), ": holds no triangle");
        assert_eq!(at("v 0 0\n", "obj"), ":1: a vertex has 3 coordinates; the line is cut short");
        assert_eq!(at("v 0 0 0\nf 1 2 3\n", "obj"), ":2: vertex 2 of 1 does not exist (yet)");
        assert_eq!(at("", "ply"), ": mesh files end in .stl or .obj, not \".ply\"");
    }

    #[test]
    fn too_many_triangles_are_refused() {
        let faces = "f 1 2 3\n".repeat(MOST + 1);
        let got = wrong(format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}").as_bytes(), "obj");
        assert_eq!(got, ": 2000001 triangles are more than 2000000: simplify the surface");
    }

    #[test]
    fn broken_binary_files_say_which_triangle() {
        assert_eq!(wrong(b"", "stl"), ": cut short: 0 bytes, an STL header has 84");
        let good = binary(&[[0.0; 3]; 3]);
        assert_eq!(wrong(&good[..100], "stl"), ": triangle 1: cut short: 100 bytes, 134 announced in the header");
        let nan = binary(&[[0.0; 3], [0.0, f32::NAN, 0.0], [0.0; 3]]);
        assert_eq!(wrong(&nan, "stl"), ": triangle 1: a coordinate is not a finite number");
    }
}
