//! What all messages are made of: their encoding, times, headers, vectors, poses.
//!
//! *Source*: OMG DDSI-RTPS 2.5, section 10 (CDR), by the crate `cdr-encoding`; ROS 2 common_interfaces (Jazzy).
//! *Parameters*: none.
//! *Deviations*: fields that only group others are written without a type of their own, because CDR has no mark for
//! them.

use byteorder::LittleEndian;
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Serialize, Serializer};

/// A message as CDR. Four bytes before it say: plain CDR, little-endian.
pub(super) fn cdr(message: &impl Serialize) -> Vec<u8> {
    // Room for most messages at once; an odometry has 720 bytes.
    let mut bytes = Vec::with_capacity(768);
    bytes.extend([0, 1, 0, 0]);
    cdr_encoding::to_writer::<_, LittleEndian, _>(&mut bytes, message)
        .expect("a message of numbers, texts and sequences becomes CDR");
    bytes
}

/// `builtin_interfaces/Time`.
#[derive(Serialize)]
pub(super) struct Time {
    sec: i32,
    nanosec: u32,
}

impl Time {
    pub(super) fn new(t_ns: u64) -> Self {
        const NS: u64 = 1_000_000_000;
        Self {
            sec: i32::try_from(t_ns / NS).expect("simulated time stays below 68 years"),
            nanosec: (t_ns % NS) as u32,
        }
    }
}

/// `std_msgs/Header`.
#[derive(Serialize)]
pub(super) struct Header<'a> {
    stamp: Time,
    frame_id: &'a str,
}

impl<'a> Header<'a> {
    pub(super) fn new(t_ns: u64, frame_id: &'a str) -> Self {
        let stamp = Time::new(t_ns);
        Self { stamp, frame_id }
    }
}

pub(super) fn xyz(v: &Vector3<f64>) -> [f64; 3] {
    (*v).into()
}

/// `geometry_msgs/Pose` and `geometry_msgs/Transform`: the place, and the quaternion in the order x, y, z, w.
pub(super) fn pose(p: &Vector3<f64>, q: &UnitQuaternion<f64>) -> ([f64; 3], [f64; 4]) {
    (xyz(p), q.coords.into())
}

/// `uint8[]`.
pub(super) fn bytes<S: Serializer>(of: &[u8], to: S) -> Result<S::Ok, S::Error> {
    to.serialize_bytes(of)
}
