//! The table of all topics that a run publishes for ROS 2.

use crate::ros::MessageKind;

/// What a publisher offers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Qos {
    /// Best effort, the newest message: the clock.
    Clock,
    /// Best effort, the newest 5 messages, as `SensorDataQoS` of ROS.
    Sensor,
    /// Reliable, the newest 10 messages, as `QoS(10)` of ROS.
    Reliable,
    /// Reliable and transient local: who comes late gets the newest message.
    Latched,
}

impl Qos {
    /// In words.
    pub fn label(self) -> &'static str {
        match self {
            Qos::Clock => "best effort, depth 1",
            Qos::Sensor => "best effort, depth 5",
            Qos::Reliable => "reliable, depth 10",
            Qos::Latched => "reliable, transient local, depth 1",
        }
    }

    /// As rmw_zenoh writes it into tokens: reliability, durability, history with its depth, deadline, lifespan,
    /// liveliness; what has its default is empty.
    pub fn chunk(self) -> &'static str {
        match self {
            Qos::Clock => "2::,1:,:,:,,",
            Qos::Sensor => "2::,5:,:,:,,",
            Qos::Reliable => "::,10:,:,:,,",
            Qos::Latched => ":1:,1:,:,:,,",
        }
    }
}

/// A topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RosTopic {
    /// Its name; `<robot>`, `<gantry>` and `<probe>` stand for names.
    pub name: &'static str,
    /// Its type.
    pub kind: MessageKind,
    /// What its publisher offers.
    pub qos: Qos,
    /// Its meaning.
    pub what: &'static str,
}

/// All topics, in the order in which `rheotaxis topics --ros2` lists them.
pub fn ros_topics() -> &'static [RosTopic] {
    ALL
}

macro_rules! topics {
    ($($id:ident: $name:literal, $kind:ident, $qos:ident, $what:literal;)*) => {
        $(pub(super) const $id: RosTopic = RosTopic {
            name: $name,
            kind: MessageKind::$kind,
            qos: Qos::$qos,
            what: $what,
        };)*
        const ALL: &[RosTopic] = &[$($id),*];
    };
}

topics! {
    CLOCK: "/clock", Clock, Clock,
        "simulated time; nodes follow it with use_sim_time";
    TF: "/tf", TfMessage, Reliable,
        "map to <robot>/base_link (estimate) and <robot>/ground_truth; a gantry's slides; base_link to camera_optical";
    TF_STATIC: "/tf_static", TfMessage, Latched,
        "links of the URDFs, <robot>/altimeter_beam (x down), map to <gantry>/<base of its URDF>";
    SCENE: "/scene", MarkerArray, Latched,
        "bed and obstacles as triangles";
    PLUME: "/plume", PointCloud2, Reliable,
        "filaments: x, y, z, size (m), mass (kg), concentration (kg/m3), stands_for";
    DESCRIPTION: "/<robot>/robot_description", Text, Latched,
        "the URDF of a robot or a gantry; in RViz set the TF prefix to its name";
    ODOM: "/<robot>/odom", Odometry, Reliable,
        "what the robot believes: pose in map, velocity over ground in <robot>/base_link";
    TRUTH: "/<robot>/ground_truth/odom", Odometry, Reliable,
        "the truth, which the robot does not know: pose in map, velocity in <robot>/ground_truth";
    IMU: "/<robot>/imu", Imu, Sensor,
        "attitude (ENU) and rates by compass and gyros; no acceleration";
    PRESSURE: "/<robot>/pressure", FluidPressure, Sensor,
        "absolute pressure, Pa: 101325 + 1025 * 9.80665 * measured depth";
    ALTIMETER: "/<robot>/altimeter", Range, Sensor,
        "height above the bed, m, along x of <robot>/altimeter_beam; +inf if none is heard";
    RANGING: "/<robot>/ranging", PointCloud2, Sensor,
        "echoes of the forward ranging: x, y, z in <robot>/base_link";
    NEAREST: "/<robot>/ranging/nearest", Range, Sensor,
        "the nearest of them, m; +inf if there is none";
    DVL: "/<robot>/dvl", TwistStamped, Sensor,
        "velocity over ground by bottom track in <robot>/base_link, while it has lock; angular is not measured";
    ADCP: "/<robot>/adcp", Vector3Stamped, Sensor,
        "velocity of the water relative to the robot in <robot>/base_link, while valid";
    FLOW: "/<robot>/flow", Vector3Stamped, Reliable,
        "believed velocity of the water over ground, in map";
    CHEMICAL: "/<robot>/chemical", Float64, Sensor,
        "newest output of the chemical sensor, V";
    CAMERA: "/<robot>/camera/compressed", CompressedImage, Sensor,
        "newest picture, JPEG, in <robot>/camera_optical";
    BEHAVIOUR: "/<robot>/behaviour", Text, Latched,
        "what a robot or a gantry is doing, when it changes";
    PLAN: "/<robot>/plan", Path, Latched,
        "the path it plans to follow, in map, when it changes";
    DECLARATION: "/<robot>/declaration", PoseStamped, Latched,
        "where a robot or a gantry declares a source, in map";
    JOINTS: "/<gantry>/joint_states", JointState, Reliable,
        "its slides: m, m/s, N";
    PROBE: "/<gantry>/probes/<probe>", Float64, Sensor,
        "output of a probe in the newest scan, V";
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_those_of_ros_and_different() {
        let names: BTreeSet<&str> = ALL.iter().map(|t| t.name).collect();
        assert_eq!(names.len(), ALL.len());
        for name in names {
            let fits = |c: char| c.is_ascii_lowercase() || "_<>/".contains(c);
            assert!(name.starts_with('/') && name.chars().all(fits), "{name}");
        }
    }
}
