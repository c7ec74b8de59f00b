"""Draws tracks piece by piece. The layout shows all pieces up to the time that is looked at."""

import numpy as np
import rerun as rr


class Track:
    """A track; `dash_m` makes it a dashed one of that length of dash and gap."""

    def __init__(self, canvas, path, color, width, period_s, dash_m=None):
        self.canvas, self.path, self.dash_m, self.period_s = canvas, path, dash_m, period_s
        self.points = []
        self.sent_s = None
        self.length = 0.0
        canvas.still(path, rr.LineStrips3D.from_fields(colors=[color], radii=[rr.Radius.ui_points(width)]))

    def add(self, t_s, position):
        """Goes on to a position, relative to the scene's origin."""
        if not np.isfinite(position).all():
            return
        if self.sent_s is None:
            self.sent_s = t_s
        if self.points:
            step = float(np.linalg.norm(position - self.points[-1]))
            if step < 1e-3:
                return
            was = self._drawn()
            self.length += step
            if was != self._drawn():
                self.points.append(position)
                self._send(t_s, was)
                return
        self.points.append(position)
        if t_s - self.sent_s >= self.period_s:
            self._send(t_s, self._drawn())

    def end(self, t_s):
        """Sends what waits."""
        self._send(t_s, self._drawn())

    def _drawn(self):
        return self.dash_m is None or (self.length / self.dash_m) % 2.0 < 1.0

    def _send(self, t_s, drawn):
        if drawn and len(self.points) > 1:
            self.canvas.at(t_s, self.path, rr.LineStrips3D.from_fields(strips=[np.array(self.points, np.float32)]))
        self.points = self.points[-1:]
        self.sent_s = t_s


class Trail:
    """Places that stay: detections, pictures of the bed. At most one in `apart_m`."""

    def __init__(self, canvas, path, color, width, apart_m):
        self.canvas, self.path, self.apart_m = canvas, path, apart_m
        self.last = None
        canvas.still(path, rr.Points3D.from_fields(colors=[color], radii=[rr.Radius.ui_points(width)]))

    def add(self, t_s, position):
        """Marks a place, relative to the scene's origin."""
        if self.last is not None and np.linalg.norm(position - self.last) < self.apart_m:
            return
        self.last = position
        self.canvas.at(t_s, self.path, rr.Points3D.from_fields(positions=[position]))
