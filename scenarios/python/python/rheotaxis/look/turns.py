"""Quaternions (x, y, z, w)."""

import numpy as np


def times(a, b):
    """The rotation `b` followed by `a`."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return np.array(
        [
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ]
    )


def about(axis, angle):
    """The rotation by an angle (rad) about an axis."""
    axis = np.asarray(axis, float)
    size = np.linalg.norm(axis)
    if size == 0.0:
        return np.array([0.0, 0.0, 0.0, 1.0])
    return np.append(axis / size * np.sin(0.5 * angle), np.cos(0.5 * angle))


def turn(q, v):
    """A vector turned by a quaternion."""
    u = np.asarray(q[:3], float)
    v = np.asarray(v, float)
    return v + 2.0 * np.cross(u, np.cross(u, v) + q[3] * v)


def from_compass(heading_rad, pitch_up_rad=0.0, roll_right_rad=0.0):
    """Body axes (forward, left, up) of a compass heading, pitch (nose up) and roll (right side down)."""
    yaw = about([0, 0, 1], 0.5 * np.pi - heading_rad)
    return times(times(yaw, about([0, 1, 0], -pitch_up_rad)), about([1, 0, 0], roll_right_rad))
