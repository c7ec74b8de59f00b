//! Messages of states, texts, joints, pictures and clouds of points.
//!
//! *Source*: ROS 2 common_interfaces (Jazzy); REP 103 (units and axes), REP 105 (frames).
//! *Parameters*: none.
//! *Deviations*: covariances are zero, which means "unknown" in ROS.

use super::cdr::{Header, Time, bytes, cdr, pose, xyz};
use nalgebra::{UnitQuaternion, Vector3};
use robots::handoff::RangeScan;
use serde::Serialize;
use world::frames::Pose;

/// An `Odometry`: the pose of `child` in `frame`; its velocity, m/s, and angular velocity, rad/s, in its own axes.
pub fn odometry(t_ns: u64, [frame, child]: [&str; 2], at: &Pose, [linear, angular]: [Vector3<f64>; 2]) -> Vec<u8> {
    const UNKNOWN: [[f64; 6]; 6] = [[0.0; 6]; 6];
    let twist = (xyz(&linear), xyz(&angular));
    cdr(&(Header::new(t_ns, frame), child, (pose(&at.p_WB, &at.R_WB), UNKNOWN), (twist, UNKNOWN)))
}

/// A `Float64`.
pub fn float64(v: f64) -> Vec<u8> {
    cdr(&v)
}

/// A `String`.
pub fn text(s: &str) -> Vec<u8> {
    cdr(&s)
}

/// A `Vector3Stamped`.
pub fn vector3_stamped(t_ns: u64, frame: &str, v: &Vector3<f64>) -> Vec<u8> {
    cdr(&(Header::new(t_ns, frame), xyz(v)))
}

/// A `PoseStamped`.
pub fn pose_stamped(t_ns: u64, frame: &str, p: &Vector3<f64>, q: &UnitQuaternion<f64>) -> Vec<u8> {
    cdr(&(Header::new(t_ns, frame), pose(p, q)))
}

/// Pose of a frame in another, for a `TFMessage`.
#[derive(Clone, Debug, PartialEq)]
pub struct Transform {
    /// Time, ns.
    pub t_ns: u64,
    /// The other frame.
    pub parent: String,
    /// The frame.
    pub child: String,
    /// Position, m.
    pub position: Vector3<f64>,
    /// Attitude.
    pub attitude: UnitQuaternion<f64>,
}

/// A `TFMessage`.
pub fn transforms(all: &[Transform]) -> Vec<u8> {
    let stamped = all.iter().map(|t| {
        let pose = pose(&t.position, &t.attitude);
        (Header::new(t.t_ns, &t.parent), t.child.as_str(), pose)
    });
    cdr(&stamped.collect::<Vec<_>>())
}

/// A `Clock`.
pub fn clock(t_ns: u64) -> Vec<u8> {
    cdr(&Time::new(t_ns))
}

/// `sensor_msgs/CompressedImage`.
#[derive(Serialize)]
pub(super) struct CompressedImage<'a> {
    pub(super) header: Header<'a>,
    pub(super) format: &'a str,
    #[serde(serialize_with = "bytes")]
    pub(super) data: &'a [u8],
}

/// A `CompressedImage`: a picture of an optical frame (x right in the picture, y down, z into the scene) as the bytes
/// of a `png` or `jpeg` file.
pub fn compressed_image(t_ns: u64, frame: &str, format: &str, file: &[u8]) -> Vec<u8> {
    cdr(&CompressedImage { header: Header::new(t_ns, frame), format, data: file })
}

/// State of a joint at one time, for a `JointState`.
#[derive(Clone, Copy, Debug)]
pub struct Joint<'a> {
    /// Its name in the URDF.
    pub name: &'a str,
    /// Position, m or rad.
    pub position: f64,
    /// Speed, m/s or rad/s.
    pub velocity: f64,
    /// Force or torque of its drive, N or N m.
    pub effort: f64,
}

/// A `JointState`.
pub fn joint_state(t_ns: u64, frame: &str, joints: &[Joint]) -> Vec<u8> {
    let names: Vec<&str> = joints.iter().map(|j| j.name).collect();
    let columns: [fn(&Joint) -> f64; 3] = [|j| j.position, |j| j.velocity, |j| j.effort];
    let columns = columns.map(|of| joints.iter().map(of).collect::<Vec<_>>());
    cdr(&(Header::new(t_ns, frame), names, columns))
}

/// The echoes of a ping in body axes, as a `PointCloud2`.
pub fn echo_cloud(t_ns: u64, frame: &str, scan: &RangeScan) -> Vec<u8> {
    let points: Vec<[f32; 3]> = (scan.echoes_B()).map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
    point_cloud(t_ns, frame, ["x", "y", "z"], &points)
}

/// A `PointCloud2` with the named 32-bit fields; for each point, `rows` holds one value per field.
pub fn point_cloud<const N: usize>(t_ns: u64, frame: &str, names: [&str; N], rows: &[[f32; N]]) -> Vec<u8> {
    #[derive(Serialize)]
    struct PointField<'a> {
        name: &'a str,
        offset: u32,
        datatype: u8,
        count: u32,
    }
    #[derive(Serialize)]
    struct PointCloud2<'a> {
        header: Header<'a>,
        height: u32,
        width: u32,
        fields: Vec<PointField<'a>>,
        is_bigendian: bool,
        point_step: u32,
        row_step: u32,
        #[serde(serialize_with = "bytes")]
        data: &'a [u8],
        is_dense: bool,
    }
    const FLOAT32: u8 = 7;
    let length = |n: usize| u32::try_from(n).expect("a message holds fewer than 2^32 bytes");
    let field = |(k, name)| PointField { name, offset: length(4 * k), datatype: FLOAT32, count: 1 };
    let data: Vec<u8> = rows.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
    cdr(&PointCloud2 {
        header: Header::new(t_ns, frame),
        height: 1,
        width: length(rows.len()),
        fields: names.into_iter().enumerate().map(field).collect(),
        is_bigendian: false,
        point_step: length(4 * N),
        row_step: length(data.len()),
        data: &data,
        is_dense: true,
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use nalgebra::Quaternion;

    pub(in super::super) const T_NS: u64 = 1_000_000_005;
    /// That time, the frame `world`, and the padding after it.
    pub(in super::super) const HEADER: &str = "0100000005000000 06000000776f726c64000000";
    /// The pose below: places at multiples of 8.
    const POSE: &str = "000000000000f03f 0000000000000440 00000000000008c0 \
                        0000000000000000 0000000000000000 333333333333e33f 9a9999999999e93f";

    pub(in super::super) fn p() -> Vector3<f64> {
        Vector3::new(1.0, 2.5, -3.0)
    }

    pub(in super::super) fn q() -> UnitQuaternion<f64> {
        UnitQuaternion::new_unchecked(Quaternion::new(0.8, 0.0, 0.0, 0.6))
    }

    /// The bytes after the four that name the encoding.
    pub(in super::super) fn is(message: &[u8], body: &str) {
        let hex: String = message.iter().map(|b| format!("{b:02x}")).collect();
        let body: String = body.split_whitespace().collect();
        assert_eq!(hex, format!("00010000{body}"));
    }

    #[test]
    fn messages_keep_their_bytes() {
        let velocities = [Vector3::new(0.5, 0.0, -0.25), p()];
        let unknown = "00".repeat(36 * 8);
        let linear = "000000000000e03f 0000000000000000 000000000000d0bf";
        let angular = "000000000000f03f 0000000000000440 00000000000008c0";
        let joint = |name, position, velocity, effort| Joint { name, position, velocity, effort };
        let joints = [joint("x", 1.0, 2.0, -1.0), joint("arm", 0.5, 0.0, 4.0)];
        let children = ["a", "bcd"].map(|child| Transform {
            t_ns: T_NS,
            parent: "world".into(),
            child: child.into(),
            position: p(),
            attitude: q(),
        });
        for (message, body) in [
            (float64(-2.5), "00000000000004c0"),
            (text("find"), "0500000066696e6400"),
            (text(""), "0100000000"),
            (clock(T_NS), "0100000005000000"),
            (vector3_stamped(T_NS, "auv", &p()), &format!("0100000005000000 0400000061757600 {angular}")),
            (pose_stamped(T_NS, "world", &p(), &q()), &format!("{HEADER} 00000000 {POSE}")),
            (
                odometry(T_NS, ["world", "auv"], &Pose { p_WB: p(), R_WB: q() }, velocities),
                &format!("{HEADER} 0400000061757600 00000000 {POSE} {unknown} {linear} {angular} {unknown}"),
            ),
            (
                transforms(&children),
                &format!("02000000 {HEADER} 020000006100 0000 {POSE} {HEADER} 0400000062636400 00000000 {POSE}"),
            ),
            (
                point_cloud(T_NS, "map", ["x", "p"], &[[1.0, 0.5], [-2.0, 0.25]]),
                "0100000005000000 040000006d617000 01000000 02000000 02000000 \
                 0200000078000000 00000000 07000000 01000000 \
                 0200000070000000 04000000 07000000 01000000 \
                 00000000 08000000 10000000 10000000 0000803f0000003f000000c00000803e 01",
            ),
            (
                joint_state(T_NS, "world", &joints),
                &format!(
                    "{HEADER} 02000000 0200000078000000 0400000061726d00 \
                     02000000 00000000 000000000000f03f 000000000000e03f \
                     02000000 00000000 0000000000000040 0000000000000000 \
                     02000000 00000000 000000000000f0bf 0000000000001040"
                ),
            ),
            (
                compressed_image(T_NS, "camera", "png", &[0x89, b'P', b'N']),
                "0100000005000000 0700000063616d65726100 00 04000000706e6700 03000000 89504e",
            ),
        ] {
            is(&message, body);
        }
    }
}
