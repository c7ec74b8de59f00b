"""Puts data onto a Rerun stream, on one timeline: `sim`, seconds of simulated time."""

import numpy as np
import rerun as rr

#: Name of the timeline.
TIMELINE = "sim"
#: Rows of a value that are sent together.
TOGETHER = 1024


class Canvas:
    """Rows of scalars and poses are sent together; all else at once."""

    def __init__(self, stream):
        self.stream = stream
        # Wall clock times say nothing about a simulated mission.
        rr.set_log_time_enabled(False, recording=stream)
        rr.set_log_tick_enabled(False, recording=stream)
        self._scalars = {}
        self._poses = {}

    def still(self, path, *things):
        """What holds at all times."""
        self.stream.log(path, *things, static=True)

    def at(self, t_s, path, *things):
        """What holds from a time on."""
        self.stream.set_time(TIMELINE, duration=float(t_s))
        self.stream.log(path, *things)

    def line(self, path, name, color, width=1.6):
        """The style of a value's line in a chart."""
        self.still(path, rr.SeriesLines(colors=[color], names=name, widths=width))

    def scalar(self, t_s, path, value):
        """A value at a time; what is not finite leaves a gap."""
        times, values = self._scalars.setdefault(path, ([], []))
        times.append(float(t_s))
        values.append(float(value) if np.isfinite(value) else np.nan)
        if len(times) >= TOGETHER:
            self._send_scalars(path)

    def pose(self, t_s, path, position=None, quaternion=None):
        """A pose relative to the parent; each call for a path must give the same parts."""
        rows = self._poses.setdefault(path, ([], [], []))
        rows[0].append(float(t_s))
        if position is not None:
            rows[1].append(np.asarray(position, np.float32))
        if quaternion is not None:
            rows[2].append(np.asarray(quaternion, np.float32))
        if len(rows[0]) >= TOGETHER:
            self._send_poses(path)

    def flush(self):
        """Sends what waits."""
        for path in list(self._scalars):
            self._send_scalars(path)
        for path in list(self._poses):
            self._send_poses(path)

    def _send_scalars(self, path):
        times, values = self._scalars.pop(path)
        columns = rr.Scalars.columns(scalars=np.array(values))
        rr.send_columns(path, [rr.TimeColumn(TIMELINE, duration=times)], columns, recording=self.stream)

    def _send_poses(self, path):
        times, places, turns = self._poses.pop(path)
        parts = {}
        if places:
            parts["translation"] = np.array(places)
        if turns:
            parts["quaternion"] = np.array(turns)
        columns = rr.Transform3D.columns(**parts)
        rr.send_columns(path, [rr.TimeColumn(TIMELINE, duration=times)], columns, recording=self.stream)


def mesh(shape, color):
    """A shape (points, triangles, normals) as a mesh of one colour (8 bits; the fourth number is its opacity)."""
    points, triangles, normals = shape
    return rr.Mesh3D(
        vertex_positions=np.asarray(points, np.float32),
        triangle_indices=np.asarray(triangles, np.uint32),
        vertex_normals=np.asarray(normals, np.float32),
        albedo_factor=color,
    )
