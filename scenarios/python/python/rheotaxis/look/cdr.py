"""The ROS 2 messages of a recording, decoded from CDR.

*Source*: OMG DDS-XTypes (plain CDR, little endian), ROS 2 common_interfaces. Numbers are aligned to their own size,
counted from after the four bytes of the head.
"""

import struct

import numpy as np


class Cdr:
    """Reads a message from its beginning to its end."""

    __slots__ = ("data", "at")

    def __init__(self, data):
        if len(data) < 4 or data[1] != 1:
            raise ValueError("no little-endian CDR")
        self.data = data
        self.at = 4

    def _take(self, kind, size, count=1):
        self.at += -(self.at - 4) % size
        values = struct.unpack_from(f"<{count}{kind}", self.data, self.at)
        self.at += size * count
        return values

    def u8(self):
        return self._take("B", 1)[0]

    def i32(self):
        return self._take("i", 4)[0]

    def u32(self):
        return self._take("I", 4)[0]

    def f64(self, count=1):
        return self._take("d", 8, count)

    def raw_of(self, kind, size, count):
        """Values that are passed over or taken as they are."""
        return self._take(kind, size, count) if count else ()

    def text(self):
        size = self.u32()
        raw = bytes(self.raw(size))
        return raw[:-1].decode("utf-8", "replace")

    def raw(self, size):
        if self.at + size > len(self.data):
            raise ValueError("the message ends too early")
        self.at += size
        return self.data[self.at - size : self.at]

    def stamp_s(self):
        """A time as seconds."""
        return self.i32() + 1e-9 * self.u32()

    def header(self):
        """Time (s) and frame."""
        return self.stamp_s(), self.text()


def float64(data):
    """`std_msgs/Float64`."""
    return Cdr(data).f64()[0]


def string(data):
    """`std_msgs/String`."""
    return Cdr(data).text()


def odometry(data):
    """`nav_msgs/Odometry`: position, quaternion, linear velocity in body axes."""
    c = Cdr(data)
    c.header()
    c.text()
    pose = c.f64(7)
    c.f64(36)
    velocity = c.f64(3)
    return np.array(pose[:3]), np.array(pose[3:]), np.array(velocity)


def pose_stamped(data):
    """`geometry_msgs/PoseStamped`: time (s), position, quaternion."""
    c = Cdr(data)
    t_s, _ = c.header()
    pose = c.f64(7)
    return t_s, np.array(pose[:3]), np.array(pose[3:])


def path(data):
    """`nav_msgs/Path`: points (n, 3)."""
    c = Cdr(data)
    c.header()
    points = []
    for _ in range(c.u32()):
        c.header()
        points.append(c.f64(7)[:3])
    return np.array(points).reshape(-1, 3)


def vector3_stamped(data):
    """`geometry_msgs/Vector3Stamped`."""
    c = Cdr(data)
    c.header()
    return np.array(c.f64(3))


def transforms(data):
    """`tf2_msgs/TFMessage`: rows of parent, child, translation, quaternion."""
    c = Cdr(data)
    rows = []
    for _ in range(c.u32()):
        _, parent = c.header()
        child = c.text()
        pose = c.f64(7)
        rows.append((parent, child, np.array(pose[:3]), np.array(pose[3:])))
    return rows


def joint_state(data):
    """`sensor_msgs/JointState`: position of each joint by name."""
    c = Cdr(data)
    c.header()
    names = [c.text() for _ in range(c.u32())]
    count = c.u32()
    positions = c.f64(count) if count else ()
    return dict(zip(names, positions))


def compressed_image(data):
    """`sensor_msgs/CompressedImage`: frame, format, bytes of the file."""
    c = Cdr(data)
    _, frame = c.header()
    kind = c.text()
    return frame, kind, bytes(c.raw(c.u32()))


def markers(data):
    """`visualization_msgs/MarkerArray`: rows of namespace and points (n, 3)."""
    c = Cdr(data)
    rows = []
    for _ in range(c.u32()):
        c.header()
        name = c.text()
        _id_type_action = (c.i32(), c.i32(), c.i32())
        c.f64(10)  # pose, scale
        c.raw_of("f", 4, 4)  # colour
        _lifetime_locked = (c.i32(), c.u32(), c.u8())
        count = c.u32()
        points = c.f64(3 * count) if count else ()
        c.raw_of("f", 4, 4 * c.u32())
        c.text()  # texture: its name, then a picture
        c.header()
        c.text()
        c.raw(c.u32())
        c.raw_of("f", 4, 2 * c.u32())
        c.text()
        c.text()
        c.text()  # a mesh: its name, then a file
        c.raw(c.u32())
        c.u8()
        rows.append((name, np.array(points).reshape(-1, 3)))
    return rows


def log(data):
    """`rcl_interfaces/Log`: time (s), level, name, line."""
    c = Cdr(data)
    return c.stamp_s(), c.u8(), c.text(), c.text()


#: NumPy's names of the types of a field.
_TYPES = {1: "i1", 2: "u1", 3: "<i2", 4: "<u2", 5: "<i4", 6: "<u4", 7: "<f4", 8: "<f8"}


def point_cloud(data):
    """`sensor_msgs/PointCloud2`: its frame, and a dictionary of one array for each field."""
    c = Cdr(data)
    _t, frame = c.header()
    height, width = c.u32(), c.u32()
    names, formats, offsets = [], [], []
    for _ in range(c.u32()):
        names.append(c.text())
        offsets.append(c.u32())
        formats.append(_TYPES[c.u8()])
        c.u32()
    c.u8()
    step, _row = c.u32(), c.u32()
    raw = c.raw(c.u32())
    kind = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": step})
    rows = np.frombuffer(raw, kind, count=height * width)
    return frame, {name: rows[name] for name in names}


def points(fields):
    """The places of a cloud, (n, 3)."""
    return np.stack([fields["x"], fields["y"], fields["z"]], axis=1).astype(np.float64)
