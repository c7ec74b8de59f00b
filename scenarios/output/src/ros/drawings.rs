//! Messages to look at: surfaces of triangles, and ways.
//!
//! *Source*: ROS 2 common_interfaces (Jazzy): `visualization_msgs/MarkerArray`, `nav_msgs/Path`.
//! *Parameters*: none.
//! *Deviations*: none.

use super::cdr::{Header, bytes, cdr, pose, xyz};
use nalgebra::{UnitQuaternion, Vector3};
use serde::Serialize;

/// A surface of triangles of one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Its name, unique in a message.
    pub name: String,
    /// Red, green, blue, opacity, 0 to 1.
    pub colour: [f32; 4],
    /// Corners in the frame of the message, m; anticlockwise seen from outside.
    pub triangles: Vec<[Vector3<f64>; 3]>,
}

/// A `MarkerArray` of surfaces.
#[must_use]
pub fn marker_array(t_ns: u64, frame: &str, markers: &[Marker]) -> Vec<u8> {
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
        colors: [u32; 1],
        texture_resource: &'a str,
        texture: Picture<'a>,
        uv_coordinates: [u32; 1],
        text: &'a str,
        mesh_resource: &'a str,
        mesh_file: File<'a>,
        mesh_use_embedded_materials: bool,
    }
    #[derive(Serialize)]
    struct Picture<'a> {
        header: Header<'a>,
        format: &'a str,
        #[serde(serialize_with = "bytes")]
        data: &'a [u8],
    }
    #[derive(Serialize)]
    struct File<'a> {
        filename: &'a str,
        #[serde(serialize_with = "bytes")]
        data: &'a [u8],
    }
    const TRIANGLE_LIST: i32 = 11;
    const ADD: i32 = 0;
    /// The length of a sequence without elements.
    const EMPTY: [u32; 1] = [0];
    let messages = markers.iter().map(|marker| {
        let Marker {
            name,
            colour,
            triangles,
        } = marker;
        Message {
            header: Header::new(t_ns, frame),
            ns: name,
            id: 0,
            kind: TRIANGLE_LIST,
            action: ADD,
            pose: pose(&Vector3::zeros(), &UnitQuaternion::identity()),
            scale: [1.0; 3],
            color: *colour,
            lifetime: (0, 0),
            frame_locked: false,
            points: triangles.as_flattened().iter().map(xyz).collect(),
            colors: EMPTY,
            texture_resource: "",
            texture: Picture {
                header: Header::new(0, ""),
                format: "",
                data: &[],
            },
            uv_coordinates: EMPTY,
            text: "",
            mesh_resource: "",
            mesh_file: File {
                filename: "",
                data: &[],
            },
            mesh_use_embedded_materials: false,
        }
    });
    cdr(&messages.collect::<Vec<_>>())
}

/// A `Path` through points (m), without directions.
#[must_use]
pub fn path(t_ns: u64, frame: &str, points: &[Vector3<f64>]) -> Vec<u8> {
    let straight = UnitQuaternion::identity();
    let poses: Vec<_> = (points.iter())
        .map(|p| (Header::new(t_ns, frame), pose(p, &straight)))
        .collect();
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
        let bed = Marker {
            name: "bed".into(),
            colour: [1.0, 0.5, 0.0, 1.0],
            triangles: vec![[p(); 3]],
        };
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
        is(
            &path(T_NS, "world", &[p()]),
            &format!("{HEADER} 01000000 {HEADER} 00000000 {PLACE} {STRAIGHT}"),
        );
    }
}
