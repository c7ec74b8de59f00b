//! The ROS 2 messages that we record, encoded in CDR.
//!
//! *Source*: ROS 2 common_interfaces (Jazzy); REP 103 (units and axes), REP 105 (frames).
//! *Parameters*: none.
//! *Deviations*: covariances are zero, which means "unknown" in ROS.

use super::cdr::Cdr;
use nalgebra::{UnitQuaternion, Vector3};

/// A kind of message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// `nav_msgs/msg/Odometry`.
    Odometry,
    /// `std_msgs/msg/Float64`.
    Float64,
    /// `std_msgs/msg/String`.
    Text,
    /// `geometry_msgs/msg/Vector3Stamped`.
    Vector3Stamped,
    /// `geometry_msgs/msg/PoseStamped`.
    PoseStamped,
    /// `tf2_msgs/msg/TFMessage`.
    TfMessage,
    /// `rosgraph_msgs/msg/Clock`.
    Clock,
    /// `sensor_msgs/msg/PointCloud2`.
    PointCloud2,
    /// `sensor_msgs/msg/JointState`.
    JointState,
    /// `sensor_msgs/msg/CompressedImage`.
    CompressedImage,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Kind; 10] = [
        Kind::Odometry,
        Kind::Float64,
        Kind::Text,
        Kind::Vector3Stamped,
        Kind::PoseStamped,
        Kind::TfMessage,
        Kind::Clock,
        Kind::PointCloud2,
        Kind::JointState,
        Kind::CompressedImage,
    ];
}

fn xyz(v: &Vector3<f64>) -> [f64; 3] {
    [v.x, v.y, v.z]
}

fn xyzw(q: &UnitQuaternion<f64>) -> [f64; 4] {
    [q.i, q.j, q.k, q.w]
}

/// Position and attitude of `child` in `frame`; velocities in the child's axes.
#[derive(Clone, Debug)]
pub struct Odometry<'a> {
    /// Time, ns.
    pub t_ns: u64,
    /// Frame of the pose.
    pub frame: &'a str,
    /// Frame of the velocities.
    pub child: &'a str,
    /// Position, m.
    pub position: Vector3<f64>,
    /// Attitude.
    pub attitude: UnitQuaternion<f64>,
    /// Velocity, m/s.
    pub linear: Vector3<f64>,
    /// Angular velocity, rad/s.
    pub angular: Vector3<f64>,
}

impl Odometry<'_> {
    /// As CDR.
    #[must_use]
    pub fn cdr(&self) -> Vec<u8> {
        const UNKNOWN: [f64; 36] = [0.0; 36];
        let mut c = Cdr::new();
        c.header(self.t_ns, self.frame)
            .text(self.child)
            .f64s(&xyz(&self.position))
            .f64s(&xyzw(&self.attitude))
            .f64s(&UNKNOWN)
            .f64s(&xyz(&self.linear))
            .f64s(&xyz(&self.angular))
            .f64s(&UNKNOWN);
        c.finish()
    }
}

/// A `Float64`.
#[must_use]
pub fn float64(v: f64) -> Vec<u8> {
    let mut c = Cdr::new();
    c.f64(v);
    c.finish()
}

/// A `String`.
#[must_use]
pub fn text(s: &str) -> Vec<u8> {
    let mut c = Cdr::new();
    c.text(s);
    c.finish()
}

/// A `Vector3Stamped`.
#[must_use]
pub fn vector3_stamped(t_ns: u64, frame: &str, v: &Vector3<f64>) -> Vec<u8> {
    let mut c = Cdr::new();
    c.header(t_ns, frame).f64s(&xyz(v));
    c.finish()
}

/// A `PoseStamped`.
#[must_use]
pub fn pose_stamped(t_ns: u64, frame: &str, p: &Vector3<f64>, q: &UnitQuaternion<f64>) -> Vec<u8> {
    let mut c = Cdr::new();
    c.header(t_ns, frame).f64s(&xyz(p)).f64s(&xyzw(q));
    c.finish()
}

/// A `TFMessage`: each child's pose in `parent`.
#[must_use]
pub fn transforms(
    t_ns: u64,
    parent: &str,
    children: &[(&str, Vector3<f64>, UnitQuaternion<f64>)],
) -> Vec<u8> {
    let mut c = Cdr::new();
    c.len(children.len());
    for (child, p, q) in children {
        c.header(t_ns, parent)
            .text(child)
            .f64s(&xyz(p))
            .f64s(&xyzw(q));
    }
    c.finish()
}

/// A `Clock`.
#[must_use]
pub fn clock(t_ns: u64) -> Vec<u8> {
    let mut c = Cdr::new();
    c.time(t_ns);
    c.finish()
}

/// A `CompressedImage`: a picture of an optical frame (x right in the picture, y down, z into the scene) as the bytes
/// of a `png` or `jpeg` file.
#[must_use]
pub fn compressed_image(t_ns: u64, frame: &str, format: &str, file: &[u8]) -> Vec<u8> {
    let mut c = Cdr::new();
    c.header(t_ns, frame).text(format).blob(file);
    c.finish()
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
#[must_use]
pub fn joint_state(t_ns: u64, frame: &str, joints: &[Joint]) -> Vec<u8> {
    let mut c = Cdr::new();
    c.header(t_ns, frame).len(joints.len());
    for joint in joints {
        c.text(joint.name);
    }
    let columns: [fn(&Joint) -> f64; 3] = [|j| j.position, |j| j.velocity, |j| j.effort];
    for of in columns {
        c.len(joints.len());
        for joint in joints {
            c.f64(of(joint));
        }
    }
    c.finish()
}

/// A `PointCloud2` with the named 32-bit fields; for each point, `rows` holds one value per field.
#[must_use]
pub fn point_cloud<const N: usize>(
    t_ns: u64,
    frame: &str,
    names: [&str; N],
    rows: &[[f32; N]],
) -> Vec<u8> {
    const FLOAT32: u8 = 7;
    let step = 4 * N;
    let mut c = Cdr::new();
    c.header(t_ns, frame).u32(1).len(rows.len()).len(N);
    for (k, name) in names.iter().enumerate() {
        c.text(name).u32(4 * k as u32).u8(FLOAT32).u32(1);
    }
    let data: Vec<u8> = rows
        .iter()
        .flat_map(|r| r.iter().flat_map(|v| v.to_le_bytes()))
        .collect();
    c.bool(false)
        .len(step)
        .len(step * rows.len())
        .blob(&data)
        .bool(true);
    c.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odometry_has_the_length_of_its_definition() {
        let msg = Odometry {
            t_ns: 1,
            frame: "world",
            child: "auv0",
            position: Vector3::new(1.0, 2.0, 3.0),
            attitude: UnitQuaternion::identity(),
            linear: Vector3::zeros(),
            angular: Vector3::zeros(),
        }
        .cdr();
        // 4 header; 8 time, 4+6 "world", 2 pad, 4+5 "auv0", to 32 (3 pad); 7+36+6+36 doubles.
        assert_eq!(msg.len(), 4 + 32 + 85 * 8);
        assert_eq!(msg[4 + 32..4 + 40], 1.0f64.to_le_bytes());
        let w = 4 + 32 + 6 * 8;
        assert_eq!(msg[w..w + 8], 1.0f64.to_le_bytes());
    }

    #[test]
    fn cloud_of_one_point_by_hand() {
        let msg = point_cloud(0, "w", ["x"], &[[1.0f32]]);
        let body: Vec<u8> = [
            &[0u8; 8][..],                   // time
            &[2, 0, 0, 0, b'w', 0, 0, 0],    // frame, padded to 16
            &[1, 0, 0, 0, 1, 0, 0, 0],       // height, width
            &[1, 0, 0, 0],                   // one field
            &[2, 0, 0, 0, b'x', 0, 0, 0],    // its name, padded
            &[0, 0, 0, 0, 7, 0, 0, 0],       // offset, datatype, padded
            &[1, 0, 0, 0],                   // count
            &[0, 0, 0, 0],                   // little-endian, padded
            &[4, 0, 0, 0, 4, 0, 0, 0],       // steps
            &[4, 0, 0, 0, 0, 0, 0x80, 0x3f], // data
            &[1],                            // dense
        ]
        .concat();
        assert_eq!(msg[4..], body);
    }

    #[test]
    fn state_of_one_joint_by_hand() {
        let joint = Joint {
            name: "j",
            position: 1.0,
            velocity: 2.0,
            effort: -1.0,
        };
        let body: Vec<u8> = [
            &[0u8; 8][..],                      // time
            &[2, 0, 0, 0, b'w', 0, 0, 0],       // frame, padded to 16
            &[1, 0, 0, 0, 2, 0, 0, 0, b'j', 0], // names
            &[0, 0],                            // padded to 28
            &[1, 0, 0, 0],                      // positions
            &[0, 0, 0, 0, 0, 0, 0xf0, 0x3f],    // 1 at 32
            &[1, 0, 0, 0, 0, 0, 0, 0],          // velocities, padded to 48
            &[0, 0, 0, 0, 0, 0, 0, 0x40],       // 2
            &[1, 0, 0, 0, 0, 0, 0, 0],          // efforts, padded to 64
            &[0, 0, 0, 0, 0, 0, 0xf0, 0xbf],    // -1
        ]
        .concat();
        assert_eq!(joint_state(0, "w", &[joint])[4..], body);
    }

    #[test]
    fn picture_of_three_bytes_by_hand() {
        let body: Vec<u8> = [
            &[1, 0, 0, 0, 5, 0, 0, 0][..],      // time
            &[2, 0, 0, 0, b'c', 0, 0, 0],       // frame, padded to 16
            &[4, 0, 0, 0, b'p', b'n', b'g', 0], // format
            &[3, 0, 0, 0, 0x89, b'P', b'N'],    // data
        ]
        .concat();
        let file = [0x89, b'P', b'N'];
        assert_eq!(
            compressed_image(1_000_000_005, "c", "png", &file)[4..],
            body
        );
    }

    #[test]
    fn clock_is_eight_bytes() {
        assert_eq!(clock(1_000_000_002), [0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    }
}
