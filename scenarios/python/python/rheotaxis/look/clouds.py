"""Draws plume, water, source maps, sidescan lines and pings of the ranging."""

import numpy as np
import rerun as rr

from . import colours

#: Most points of a cloud that are drawn.
MOST = 5000
#: A map's cells below this share of the largest are not drawn.
LEAST = 0.02


class Clouds:
    """The clouds of one run, with the scales that they share."""

    def __init__(self, canvas, scene):
        self.canvas, self.scene = canvas, scene
        self.strongest, self.decades = None, 4.0
        self.fastest = None
        #: Sentences about scales, for the legend, by name.
        self.said = {}

    def plume(self, e):
        """Filaments: coloured by the concentration at their middle, sized by their own size."""
        keep = np.isfinite(e.points).all(axis=1)
        points, size = e.points[keep], np.asarray(e.values["size"], float)[keep]
        if "concentration" in e.values:
            c = np.asarray(e.values["concentration"], float)[keep]
        else:
            one = np.asarray(e.values["mass"], float)[keep] / np.maximum(e.values.get("stands_for", [1.0]), 1.0)
            c = one / np.maximum((2.0 * np.pi) ** 1.5 * size**3, 1e-30)
        step = max(1, -(-len(points) // MOST))
        points, size, c = points[::step], size[::step], c[::step]
        good = c[c > 0]
        # A scale once set stays, so that colours mean the same all along.
        if self.strongest is None and len(good) >= 50:
            low, self.strongest = (float(q) for q in np.quantile(good, [0.02, 0.98]))
            self.decades = max(1.0, np.log10(self.strongest / low))
            low, high = 1e6 * self.strongest * 10**-self.decades, 1e6 * self.strongest
            self.said["plume"] = f"middle of a filament, {low:.2g} to {high:.2g} µg/l on a logarithmic scale"
        top = self.strongest or (float(good.max()) if len(good) else 1.0)
        share = 1.0 + np.log10(np.maximum(c, 1e-300) / top) / self.decades
        drawn = rr.Points3D(self.scene.local(points), radii=np.maximum(size, 1e-3), colors=colours.shade(share, "dye"))
        self.canvas.at(e.t_s, "world/plume", drawn)

    def water(self, e):
        """Arrows of the flow, the longest a bit shorter than the distance between neighbours."""
        v = np.stack([e.values["vx"], e.values["vy"], e.values["vz"]], axis=1).astype(float)
        keep = np.isfinite(v).all(axis=1) & np.isfinite(e.points).all(axis=1)
        v, points = v[keep][:MOST], e.points[keep][:MOST]
        if len(v) == 0:
            return
        speed = np.linalg.norm(v, axis=1)
        if self.fastest is None and speed.max() > 1e-6:
            apart = 0.6 * _apart(points[:, :2])
            self.fastest = (float(speed.max()), apart)
            self.said["water"] = f"an arrow of {apart:.3g} m is {speed.max():.2g} m/s"
        top, apart = self.fastest or (1.0, 1.0)
        self.canvas.at(
            e.t_s,
            "world/water",
            rr.Arrows3D(
                vectors=v * (apart / top),
                origins=self.scene.local(points),
                colors=colours.shade(speed / top, "flow"),
                radii=[rr.Radius.ui_points(0.7)],
            ),
        )

    def belief(self, e, path):
        """A map's likely cells as cubes; returns the entropy in nat where the cloud tells it."""
        p = np.asarray(e.values["probability"], float)
        share = p / max(float(p.max(initial=0.0)), 1e-300)
        kept = np.flatnonzero(share >= LEAST)
        kept = kept[np.argsort(-share[kept])][:MOST]
        size, turned = e.cell_m, e.turned_rad
        if size is None:
            size, turned = _cells(e.points)
        half = 0.5 * np.asarray(size, float) * (0.25 + 0.7 * np.sqrt(share[kept]))[:, None]
        turn = [0.0, 0.0, np.sin(0.5 * turned), np.cos(0.5 * turned)]
        drawn = rr.Boxes3D(
            centers=self.scene.local(e.points[kept]),
            half_sizes=half,
            quaternions=np.tile(turn, (len(kept), 1)),
            colors=colours.shade(share[kept], "belief"),
            fill_mode="solid",
        )
        self.canvas.at(e.t_s, path, drawn)
        good = p[p > 0]
        return float(-(good * np.log(good)).sum()) if len(good) else None

    def sidescan(self, e, path):
        """A line of the sidescan's picture on the bed."""
        level = np.asarray(e.values["level"], float)
        keep = np.flatnonzero(np.isfinite(level) & np.isfinite(e.points).all(axis=1))
        keep = keep[:: max(1, len(keep) // 150)]
        colors = colours.shade((level[keep] + 10.0) / 40.0, "sonar")
        at = self.scene.local(e.points[keep]) + [0.0, 0.0, 0.03]
        self.canvas.at(e.t_s, path, rr.Points3D(at, colors=colors, radii=[rr.Radius.ui_points(1.5)]))


    def ranging(self, e, path, at):
        """Echoes of the ranging and their rays, in body axes."""
        ends = e.points[np.isfinite(e.points).all(axis=1)]
        rays = np.stack([np.broadcast_to(np.asarray(at, float), ends.shape), ends], axis=1)
        dim, thin = [(*colours.ECHO, 70)], [rr.Radius.ui_points(0.6)]
        self.canvas.at(e.t_s, f"{path}/rays", rr.LineStrips3D(rays, colors=dim, radii=thin))
        self.canvas.at(e.t_s, f"{path}/echoes", rr.Points3D(ends, colors=[colours.ECHO], radii=[rr.Radius.ui_points(2)]))


def _apart(places):
    """A typical distance between neighbours in the plane, m."""
    some = np.unique(np.round(places, 3), axis=0)
    if len(some) < 2:
        return 1.0
    pick = some[:: max(1, len(some) // 60)]
    d = np.linalg.norm(pick[:, None] - some[None], axis=2)
    d[d < 1e-6] = np.inf
    return float(np.median(d.min(axis=1)))


def _cells(points):
    """Size of a map's cells (along, across, up; m) and the direction of the first axis, from their middles."""
    if len(points) < 2:
        return np.ones(3), 0.0
    middle = points[len(points) // 2]
    apart = points - middle
    level = apart[np.abs(apart[:, 2]) < 1e-3]
    length = np.linalg.norm(level[:, :2], axis=1)
    level, length = level[length > 1e-3], length[length > 1e-3]
    if len(level) == 0:
        return np.ones(3), 0.0
    first = level[np.argmin(length)]
    turned = float(np.arctan2(first[1], first[0]))
    along, across = np.array([np.cos(turned), np.sin(turned)]), np.array([-np.sin(turned), np.cos(turned)])
    on_side = level[np.abs(level[:, :2] @ along) < 1e-2 * length.min()]
    side = np.abs(on_side[:, :2] @ across).min() if len(on_side) else length.min()
    ups = np.abs(apart[:, 2])
    ups = ups[ups > 1e-3]
    up = ups.min() if len(ups) else 0.1 * length.min()
    return np.array([length.min(), side, up]), turned
