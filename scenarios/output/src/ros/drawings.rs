//! Messages to look at: surfaces of triangles, and ways.
//!
//! *Source*: ROS 2 common_interfaces (Jazzy): `visualization_msgs/MarkerArray`, `nav_msgs/Path`.
//! *Parameters*: none.
//! *Deviations*: none.

use super::cdr::{Header, bytes, cdr, pose, xyz};
use super::messages::CompressedImage;
use nalgebra::{UnitQuaternion, Vector3};
use serde::Serialize;

/// A surface of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Its name, unique in a message.
    pub name: String,
    /// Red, green, blue, opacity, 0 to 1, where `colours` says nothing.
    pub colour: [f32; 4],
    /// Colour of each corner, in the order of the triangles; empty for one colour.
    pub colours: Vec<[f32; 4]>,
    /// Corners in the frame of the message, m; anticlockwise seen from outside.
    pub triangles: Vec<[Vector3<f64>; 3]>,
}

/// Balls of one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Balls<'a> {
    /// Their name, unique in a message.
    pub name: &'a str,
    /// Red, green, blue, opacity, 0 to 1.
    pub colour: [f32; 4],
    /// Their size, m.
    pub diameter_m: f64,
    /// Their middles in the frame of the message, m.
    pub places: &'a [Vector3<f64>],
}

/// A `visualization_msgs/Marker`.
#[derive(Serialize)]
struct Message<'a> {
    header: Header<'a>,
    ns: &'a str,
    id: i32,
    kind: i32,
    action: i32,
    pose: ([f64; 3], [f64; 4]),
    scale: [f64; 3],
    color: [f32; 4],
    lifetime: (i32, u32),
    frame_locked: bool,
    points: Vec<[f64; 3]>,
    colors: &'a [[f32; 4]],
    texture_resource: &'a str,
    texture: CompressedImage<'a>,
    uv_coordinates: [u32; 1],
    text: &'a str,
    mesh_resource: &'a str,
    mesh_file: File<'a>,
    mesh_use_embedded_materials: bool,
}

#[derive(Serialize)]
struct File<'a> {
    filename: &'a str,
    #[serde(serialize_with = "bytes")]
    data: &'a [u8],
}

const SPHERE_LIST: i32 = 7;
const TRIANGLE_LIST: i32 = 11;

impl<'a> Message<'a> {
    /// A marker that stays until another of its name comes.
    fn new(
        header: Header<'a>,
        (ns, kind): (&'a str, i32),
        scale_m: f64,
        color: [f32; 4],
        points: &[Vector3<f64>],
    ) -> Self {
        const ADD: i32 = 0;
        /// The length of a sequence without elements.
        const EMPTY: [u32; 1] = [0];
        Self {
            header,
            ns,
            id: 0,
            kind,
            action: ADD,
            pose: pose(&Vector3::zeros(), &UnitQuaternion::identity()),
            scale: [scale_m; 3],
            color,
            lifetime: (0, 0),
            frame_locked: false,
            points: points.iter().map(xyz).collect(),
            colors: &[],
            texture_resource: "",
            texture: CompressedImage { header: Header::new(0, ""), format: "", data: &[] },
            uv_coordinates: EMPTY,
            text: "",
            mesh_resource: "",
            mesh_file: File { filename: "", data: &[] },
            mesh_use_embedded_materials: false,
        }
    }
}

/// A `MarkerArray` of surfaces.
pub fn marker_array(t_ns: u64, frame: &str, markers: &[Marker]) -> Vec<u8> {
    let messages = markers.iter().map(|m| {
        let (header, corners) = (Header::new(t_ns, frame), m.triangles.as_flattened());
        let colors = m.colours.as_slice();
        Message { colors, ..Message::new(header, (&m.name, TRIANGLE_LIST), 1.0, m.colour, corners) }
    });
    cdr(&messages.collect::<Vec<_>>())
}

/// A `MarkerArray` of balls.
pub fn balls(t_ns: u64, frame: &str, all: &[Balls]) -> Vec<u8> {
    let messages = all.iter().map(|b| {
        let header = Header::new(t_ns, frame);
        Message::new(header, (b.name, SPHERE_LIST), b.diameter_m, b.colour, b.places)
    });
    cdr(&messages.collect::<Vec<_>>())
}

/// A `Path` through points (m), without directions.
pub fn path(t_ns: u64, frame: &str, points: &[Vector3<f64>]) -> Vec<u8> {
    let straight = UnitQuaternion::identity();
    let poses: Vec<_> = (points.iter()).map(|p| (Header::new(t_ns, frame), pose(p, &straight))).collect();
    cdr(&(Header::new(t_ns, frame), poses))
}

#[cfg(test)]
mod tests {
    use super::super::messages::tests::{HEADER, T_NS, is, p};
    use super::*;

    const ORIGIN: &str = "0000000000000000 0000000000000000 0000000000000000";
    const STRAIGHT: &str = "0000000000000000 0000000000000000 0000000000000000 000000000000f03f";
    const PLACE: &str = "000000000000f03f 0000000000000440 00000000000008c0";

    #[test]
    fn markers_keep_their_bytes() {
        let bed =
            Marker { name: "bed".into(), colour: [1.0, 0.5, 0.0, 1.0], colours: Vec::new(), triangles: vec![[p(); 3]] };
        is(
            &marker_array(T_NS, "world", &[bed]),
            &format!(
                "01000000 {HEADER} 04000000 62656400 00000000 0b000000 00000000 00000000 \
                 {ORIGIN} {STRAIGHT} 000000000000f03f000000000000f03f000000000000f03f \
                 0000803f 0000003f 00000000 0000803f 00000000 00000000 00 000000 \
                 03000000 {PLACE} {PLACE} {PLACE} 00000000 01000000 00 000000 \
                 00000000 00000000 01000000 00 000000 01000000 00 000000 00000000 00000000 \
                 01000000 00 000000 01000000 00 000000 01000000 00 000000 00000000 00"
            ),
        );
        is(&marker_array(T_NS, "world", &[]), "00000000");
    }

    #[test]
    fn ways_keep_their_bytes() {
        is(&path(T_NS, "world", &[p()]), &format!("{HEADER} 01000000 {HEADER} 00000000 {PLACE} {STRAIGHT}"));
    }
}
