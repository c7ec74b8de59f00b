//! The message types that we write: name, and the hash by which ROS 2 tells versions of a type apart.
//!
//! *Source*: ROS 2 common_interfaces, rcl_interfaces and geometry2; REP 2016 (type hashes). The hashes are those that
//! `rosbags` 0.11.9 computes from the definitions of Jazzy, Kilted and Lyrical, which are the same for all of these
//! types. `scenarios/clients/check_ros2.py` computes them again from [our definitions](MessageKind::schema).
//! *Parameters*: none.
//! *Deviations*: none.

/// A type of message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MessageKind {
    /// `nav_msgs/msg/Odometry`.
    Odometry,
    /// `std_msgs/msg/Float64`.
    Float64,
    /// `std_msgs/msg/String`.
    Text,
    /// `geometry_msgs/msg/Vector3Stamped`.
    Vector3Stamped,
    /// `geometry_msgs/msg/TwistStamped`.
    TwistStamped,
    /// `geometry_msgs/msg/PoseStamped`.
    PoseStamped,
    /// `nav_msgs/msg/Path`.
    Path,
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
    /// `sensor_msgs/msg/Imu`.
    Imu,
    /// `sensor_msgs/msg/FluidPressure`.
    FluidPressure,
    /// `sensor_msgs/msg/Range`.
    Range,
    /// `visualization_msgs/msg/MarkerArray`.
    MarkerArray,
    /// `rcl_interfaces/msg/Log`.
    Log,
}

/// A row of the table: type, name, hash.
type Row = (MessageKind, &'static str, &'static str);

/// All types, in the order of [`MessageKind`].
const TABLE: [Row; 17] = [
    (
        MessageKind::Odometry,
        "nav_msgs/msg/Odometry",
        "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
    ),
    (MessageKind::Float64, "std_msgs/msg/Float64", "705ba9c3d1a09df43737eb67095534de36fd426c0587779bda2bc51fe790182a"),
    (MessageKind::Text, "std_msgs/msg/String", "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"),
    (
        MessageKind::Vector3Stamped,
        "geometry_msgs/msg/Vector3Stamped",
        "d4829622288cbb443886e7ea94ea5671a3b1be6bab4ad04224432a65f7d7887a",
    ),
    (
        MessageKind::TwistStamped,
        "geometry_msgs/msg/TwistStamped",
        "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64",
    ),
    (
        MessageKind::PoseStamped,
        "geometry_msgs/msg/PoseStamped",
        "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8",
    ),
    (MessageKind::Path, "nav_msgs/msg/Path", "1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b"),
    (
        MessageKind::TfMessage,
        "tf2_msgs/msg/TFMessage",
        "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    ),
    (MessageKind::Clock, "rosgraph_msgs/msg/Clock", "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"),
    (
        MessageKind::PointCloud2,
        "sensor_msgs/msg/PointCloud2",
        "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
    ),
    (
        MessageKind::JointState,
        "sensor_msgs/msg/JointState",
        "a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e",
    ),
    (
        MessageKind::CompressedImage,
        "sensor_msgs/msg/CompressedImage",
        "15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a",
    ),
    (MessageKind::Imu, "sensor_msgs/msg/Imu", "7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b"),
    (
        MessageKind::FluidPressure,
        "sensor_msgs/msg/FluidPressure",
        "22dfb2b145a0bd5a31a1ac3882a1b32148b51d9b2f3bab250290d66f3595bc32",
    ),
    (MessageKind::Range, "sensor_msgs/msg/Range", "b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a"),
    (
        MessageKind::MarkerArray,
        "visualization_msgs/msg/MarkerArray",
        "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf",
    ),
    (MessageKind::Log, "rcl_interfaces/msg/Log", "e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac"),
];

impl MessageKind {
    /// All types.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|row| row.0)
    }

    /// Full name, such as `std_msgs/msg/Float64`.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// The name in DDS, such as `std_msgs::msg::dds_::Float64_`.
    pub fn dds_name(self) -> String {
        let parts: Vec<&str> = self.name().split('/').collect();
        let [package, kind, name] = parts[..] else { unreachable!("the names of the table have three parts") };
        format!("{package}::{kind}::dds_::{name}_")
    }

    /// The hash, such as `RIHS01_705b…`.
    pub fn hash(self) -> String {
        format!("RIHS01_{}", TABLE[self as usize].2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_the_order_of_the_types() {
        for (i, kind) in MessageKind::all().enumerate() {
            assert_eq!(kind as usize, i, "{kind:?}");
            assert_eq!(kind.hash().len(), "RIHS01_".len() + 64, "{kind:?}");
        }
    }
}
