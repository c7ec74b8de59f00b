//! Definitions of the ROS 2 messages that we write, and of the messages in them, as `ros2msg` schemas.
//!
//! *Source*: ROS 2 common_interfaces, rcl_interfaces and geometry2 (Jazzy; unchanged up to Rolling).
//! *Parameters*: none.
//! *Deviations*: comments of the originals are omitted; fields, order and types are the same.
//! *Written here*: crates of message definitions need a ROS installation or bring hundreds of types.

use super::MessageKind;

const TIME: (&str, &str) = ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n");
const HEADER: (&str, &str) = ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n");
const POINT: (&str, &str) = ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n");
const VECTOR3: (&str, &str) = ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n");
const QUATERNION: (&str, &str) = ("geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n");
const POSE: (&str, &str) = ("geometry_msgs/Pose", "Point position\nQuaternion orientation\n");
const POSE_COV: (&str, &str) = ("geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance\n");
const TWIST: (&str, &str) = ("geometry_msgs/Twist", "Vector3 linear\nVector3 angular\n");
const TWIST_COV: (&str, &str) = ("geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance\n");
const TRANSFORM: (&str, &str) = ("geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n");
const TRANSFORM_STAMPED: (&str, &str) =
    ("geometry_msgs/TransformStamped", "std_msgs/Header header\nstring child_frame_id\nTransform transform\n");
const POSE_STAMPED: (&str, &str) = ("geometry_msgs/PoseStamped", "std_msgs/Header header\nPose pose\n");
const COMPRESSED_IMAGE: (&str, &str) =
    ("sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n");
const COLOR: (&str, &str) = ("std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n");
const DURATION: (&str, &str) = ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n");
const UV_COORDINATE: (&str, &str) = ("visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n");
const MESH_FILE: (&str, &str) = ("visualization_msgs/MeshFile", "string filename\nuint8[] data\n");
const MARKER: (&str, &str) = (
    "visualization_msgs/Marker",
    "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\nint32 LINE_STRIP=4\n\
     int32 LINE_LIST=5\nint32 CUBE_LIST=6\nint32 SPHERE_LIST=7\nint32 POINTS=8\n\
     int32 TEXT_VIEW_FACING=9\nint32 MESH_RESOURCE=10\nint32 TRIANGLE_LIST=11\nint32 ARROW_STRIP=12\n\
     int32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\nint32 DELETEALL=3\nstd_msgs/Header header\nstring ns\n\
     int32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\n\
     std_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\nbool frame_locked\n\
     geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n\
     sensor_msgs/CompressedImage texture\nUVCoordinate[] uv_coordinates\nstring text\n\
     string mesh_resource\nMeshFile mesh_file\nbool mesh_use_embedded_materials\n",
);
const POINT_FIELD: (&str, &str) = (
    "sensor_msgs/PointField",
    "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n\
     uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n",
);

impl MessageKind {
    /// Definition followed by those of all types in it, in the form that `ros2msg` readers expect.
    pub fn schema(self) -> String {
        let (own, parts): (&str, &[(&str, &str)]) = match self {
            MessageKind::Odometry => (
                "std_msgs/Header header\nstring child_frame_id\n\
                 geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist\n",
                &[HEADER, TIME, POSE_COV, POSE, POINT, QUATERNION, TWIST_COV, TWIST, VECTOR3],
            ),
            MessageKind::Float64 => ("float64 data\n", &[]),
            MessageKind::Text => ("string data\n", &[]),
            MessageKind::Vector3Stamped => ("std_msgs/Header header\nVector3 vector\n", &[HEADER, TIME, VECTOR3]),
            MessageKind::PoseStamped => {
                ("std_msgs/Header header\nPose pose\n", &[HEADER, TIME, POSE, POINT, QUATERNION])
            }
            MessageKind::TwistStamped => ("std_msgs/Header header\nTwist twist\n", &[HEADER, TIME, TWIST, VECTOR3]),
            MessageKind::Path => (
                "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n",
                &[HEADER, TIME, POSE_STAMPED, POSE, POINT, QUATERNION],
            ),
            MessageKind::TfMessage => (
                "geometry_msgs/TransformStamped[] transforms\n",
                &[TRANSFORM_STAMPED, HEADER, TIME, TRANSFORM, VECTOR3, QUATERNION],
            ),
            MessageKind::Clock => ("builtin_interfaces/Time clock\n", &[TIME]),
            MessageKind::PointCloud2 => (
                "std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\n\
                 bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
                &[HEADER, TIME, POINT_FIELD],
            ),
            MessageKind::JointState => (
                "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n\
                 float64[] effort\n",
                &[HEADER, TIME],
            ),
            MessageKind::CompressedImage => (COMPRESSED_IMAGE.1, &[HEADER, TIME]),
            MessageKind::Imu => (
                "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n\
                 float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n\
                 float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n\
                 float64[9] linear_acceleration_covariance\n",
                &[HEADER, TIME, QUATERNION, VECTOR3],
            ),
            MessageKind::FluidPressure => {
                ("std_msgs/Header header\nfloat64 fluid_pressure\nfloat64 variance\n", &[HEADER, TIME])
            }
            MessageKind::Range => (
                "uint8 ULTRASOUND=0\nuint8 INFRARED=1\nstd_msgs/Header header\nuint8 radiation_type\n\
                 float32 field_of_view\nfloat32 min_range\nfloat32 max_range\nfloat32 range\nfloat32 variance\n",
                &[HEADER, TIME],
            ),
            MessageKind::Log => (
                "byte DEBUG=10\nbyte INFO=20\nbyte WARN=30\nbyte ERROR=40\nbyte FATAL=50\n\
                 builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\n\
                 string function\nuint32 line\n",
                &[TIME],
            ),
            MessageKind::MarkerArray => (
                "Marker[] markers\n",
                &[
                    MARKER,
                    HEADER,
                    TIME,
                    POSE,
                    POINT,
                    QUATERNION,
                    VECTOR3,
                    COLOR,
                    DURATION,
                    COMPRESSED_IMAGE,
                    UV_COORDINATE,
                    MESH_FILE,
                ],
            ),
        };
        let mut text = own.to_owned();
        for (name, body) in parts {
            text.push_str(&"=".repeat(80));
            text.push_str("\nMSG: ");
            text.push_str(name);
            text.push('\n');
            text.push_str(body);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every type that a definition mentions is defined below it; otherwise readers refuse the channel.
    #[test]
    fn schemas_are_closed() {
        const PLAIN: [&str; 8] = ["byte", "int32", "uint32", "uint8", "float64", "string", "bool", "float32"];
        for kind in MessageKind::all() {
            let schema = kind.schema();
            let defined: Vec<&str> =
                schema.lines().filter_map(|l| l.strip_prefix("MSG: ")).map(|n| n.rsplit('/').next().unwrap()).collect();
            for line in schema.lines() {
                if line.starts_with('=') || line.starts_with("MSG: ") {
                    continue;
                }
                let base = line.split([' ', '[']).next().unwrap();
                let short = base.rsplit('/').next().unwrap();
                assert!(PLAIN.contains(&base) || defined.contains(&short), "{}: {line} is not defined", kind.name());
            }
        }
    }
}
