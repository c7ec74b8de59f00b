"""Draws one machine: body, tracks, marks, charts, states, decisions."""

import io

import numpy as np
import pyarrow as pa
import rerun as rr
from PIL import Image

from . import colours
from .bodies import Body
from .tracks import Trail, Track

#: Width of tracks, and radius of marks, points on the screen.
WIDTH, MARK = 1.6, 2.2


class Machine:
    """The drawing of one machine. Its entities: `world/machines/<id>` moves with it, `plots/<id>` are charts,
    `states/<id>` states over time, `log/<id>` what it decided."""

    def __init__(self, canvas, scene, clouds, name, number, period_s):
        self.canvas, self.scene, self.clouds, self.name = canvas, scene, clouds, name
        self.said = scene.machines.get(name, {})
        self.gantry = self.said.get("kind") == "gantry"
        part = rr.escape_entity_path_part(name)
        self.at, self.plots, self.states, self.log = (
            f"world/machines/{part}",
            f"plots/{part}",
            f"states/{part}",
            f"log/{part}",
        )
        self.marked = f"world/marks/{part}"
        color = colours.of_robot(number)
        self.color = color
        dash_m = scene.size_m() / 120.0
        believed = (
            colours.mixed(color, colours.BELIEVED, 0.8) if number == 0 else colours.mixed(color, (90, 90, 90), 0.5)
        )
        self.track = Track(canvas, f"world/tracks/{part}/true", color, WIDTH, period_s)
        self.belief = Track(canvas, f"world/tracks/{part}/believed", believed, 0.75 * WIDTH, period_s, dash_m)
        self.hits = Trail(canvas, f"world/tracks/{part}/detections", colours.DETECTION, MARK, scene.size_m() / 250.0)
        base = self.said.get("base")
        self.body = None
        if self.said.get("links"):
            self.body = Body(canvas, f"{self.at}/body", self.said)
        if base:
            canvas.still(self.at, rr.Transform3D(translation=scene.local(base["position_m"])))
            canvas.still(f"{self.at}/body", rr.Transform3D(quaternion=base["quaternion_xyzw"]))
        else:
            point = rr.Points3D([[0, 0, 0]], colors=[color], radii=[rr.Radius.ui_points(4.5)], labels=[name])
            canvas.still(f"world/machines/{part}/marker", point)
        self.true = None
        self.lines = set()
        self.full_scale = float(self.said.get("full_scale_v") or 0.0)
        share = self.said.get("threshold")
        self.threshold = None if share is None else float(share) * (self.full_scale or 1.0)
        self.above = False
        self.tells = False

    def pose(self, e):
        """Where it is, or believes it is."""
        at = self.scene.local(e.position)
        if e.believed:
            self.belief.add(e.t_s, at)
            if self.true is not None:
                self._chart(
                    e.t_s,
                    "position_error/m",
                    "position error",
                    float(np.linalg.norm((at - self.true)[:2])),
                    (255, 150, 60),
                )
            return
        self.true = at
        self.canvas.pose(e.t_s, self.at, at)
        self.canvas.pose(e.t_s, f"{self.at}/body", quaternion=e.quaternion)
        self.track.add(e.t_s, at)
        self._chart(e.t_s, "height/vehicle", "vehicle", float(e.position[2]), self.color)
        if e.speed_m_s is not None:
            self._chart(e.t_s, "speed/m_s", "speed over ground", e.speed_m_s, (130, 200, 255))

    def number(self, e):
        """A value: a chart's, or a drive's that moves the body."""
        if e.name == "volts":
            self._reading(e)
        elif e.name == "altitude_m":
            if self.true is not None:
                self._chart(e.t_s, "height/bed", "bed", float(self.true[2]) - e.value, (196, 168, 120))
        elif e.name.startswith(("probes/", "thresholds/")):
            kind, _, n = e.name.partition("/")
            n = int(n)
            color = [(120, 200, 255), (255, 190, 90), (150, 230, 130), (240, 130, 200)][n % 4]
            if kind == "thresholds":
                color = colours.mixed(color, (40, 40, 40), 0.45)
            words = f"probe {n}" if kind == "probes" else f"threshold {n}"
            self._chart(e.t_s, f"probes/{n}/{kind}", words, e.value, color)
        elif e.name == "spike_hz":
            self._chart(e.t_s, "spikes/hz", "spikes a second", e.value, (255, 190, 90))
        elif e.name == "flow_m_s":
            self._chart(e.t_s, "speed/flow", "flow as believed", e.value, (90, 220, 190))
        elif e.name == "entropy_nat":
            self._chart(e.t_s, "map/entropy", "entropy of the map", e.value, (150, 230, 130))
        elif self.body is not None:
            self.body.actuator(e.t_s, e.name, e.value)

    def _reading(self, e):
        self._chart(e.t_s, "reading/volts", "reading", e.value, (190, 235, 120))
        if self.threshold is None:
            return
        self._chart(e.t_s, "reading/threshold", "threshold", self.threshold, colours.LOST)
        above = e.value >= self.threshold
        if above and self.true is not None:
            self.hits.add(e.t_s, self.true)
        if above and not self.lines & {"first detection"}:
            self.lines.add("first detection")
            self.decided(e.t_s, f"first reading above the threshold: {e.value:.3f} V")

    def words(self, e):
        """A state, as a lane of the timeline; changes of the behaviour are told in the log."""
        if e.name == "layers":
            for layer in filter(None, (x.strip() for x in e.text.split(","))):
                name, _, state = layer.rpartition(" ")
                self._state(e.t_s, f"layer_{name}", state if state != "silent" else None)
        elif e.name == "layer":
            if e.text:
                self.decided(e.t_s, f"layer {e.text} holds the vehicle")
        else:
            self._state(e.t_s, e.name, e.text or None)
            if e.text:
                self.decided(e.t_s, f"{e.name}: {e.text}{self._here()}")

    def place(self, e):
        """A part of a gantry: its head leaves a track."""
        if e.name == "head":
            self.true = self.scene.local(e.position)
            self.track.add(e.t_s, self.true)
            self.canvas.pose(e.t_s, f"{self.at}_head", self.true)

    def joints(self, e):
        """Positions of a gantry's joints."""
        for name, value in e.positions.items():
            if self.body is not None:
                self.body.move(e.t_s, name, value)
            self._chart(e.t_s, f"axes/{name}", name.replace("_", " "), value, colours.of_robot(2 + len(name) % 3))

    def way(self, e):
        """A planned path, the line to the goal, or the outline of the zone that a declaration rule looks at."""
        color, width = {"plan": (colours.PLAN, 2.2), "zone": (colours.ZONE, 1.6)}.get(e.name, (colours.GOAL, 1.0))
        path = f"{self.marked}/{e.name}"
        if len(e.points) < 2:
            self.canvas.at(e.t_s, path, rr.Clear(recursive=False))
            return
        strip = self.scene.local(e.points)
        self.canvas.at(e.t_s, path, rr.LineStrips3D([strip], colors=[color], radii=[rr.Radius.ui_points(width)]))

    def marks(self, e):
        """Places of one meaning."""
        points = e.points
        if points.shape[-1] == 2:
            z = self.true[2] if self.true is not None else 0.0
            points = np.column_stack([points, np.full(len(points), z)])
        color, radius = (colours.ZONE, MARK) if e.name == "zone_points" else (colours.LOST, MARK + 1.0)
        drawn = rr.Points3D(self.scene.local(points), colors=[color], radii=[rr.Radius.ui_points(radius)])
        self.canvas.at(e.t_s, f"{self.marked}/{e.name}", drawn)

    def declared(self, e):
        """A declared source: a stake through the water."""
        x, y = self.scene.local(e.position[:2])
        low = min(
            -0.05 * self.scene.size_m() if self.scene.bed is None else -self.scene.depth_m(),
            float(np.nan_to_num(e.position[2])),
        )
        stake = np.array([[x, y, low], [x, y, 0.0]])
        path = f"{self.marked}/declared_{e.number}"
        color = [colours.DECLARED]
        self.canvas.at(e.t_s, f"{path}/stake", rr.LineStrips3D([stake], colors=color, radii=[rr.Radius.ui_points(2.0)]))
        words = "declared" if len(self.scene.machines) < 2 else f"declared by {self.name}"
        head = rr.Points3D([[x, y, 0.0]], colors=color, radii=[rr.Radius.ui_points(5.5)], labels=[words])
        self.canvas.at(e.t_s, f"{path}/head", head)
        place = f"{e.position[0]:.1f} m east, {e.position[1]:.1f} m north"
        self.decided(e.t_s, f"declares a source at {place}" + (f": {e.words}" if e.words else ""), "WARN")

    def picture(self, e):
        """A picture with the camera's view in the scene."""
        try:
            width, height = Image.open(io.BytesIO(e.data)).size
        except (OSError, ValueError):
            return
        camera = self.scene.sensor(self.name, "camera") or {}
        view = e.view_rad or camera.get("view_rad") or 1.0
        path = f"{self.at}/body/camera" if e.mounted else f"{self.marked}/camera"
        if e.position is not None:
            at = e.position if e.mounted else self.scene.local(e.position)
            self.canvas.at(e.t_s, path, rr.Transform3D(translation=at, quaternion=e.quaternion))
        # A number of NumPy's is none to Rerun.
        focal = float(0.5 * width / np.tan(0.5 * view))
        lens = rr.Pinhole(
            focal_length=focal, width=width, height=height, image_plane_distance=1.5, camera_xyz=rr.ViewCoordinates.RDF
        )
        self.canvas.at(e.t_s, path, lens, rr.EncodedImage(contents=e.data, media_type=e.media))

    def cloud(self, e):
        """A map, a line of the sidescan, or a ping of the ranging."""
        if e.name == "map":
            entropy = self.clouds.belief(e, f"{self.marked}/belief")
            if entropy is not None and "entropy_nat" not in e.values:
                self._chart(e.t_s, "map/entropy", "entropy of the map", entropy, (150, 230, 130))
        elif e.name == "sidescan":
            self.clouds.sidescan(e, f"{self.marked}/sidescan")
        elif e.name == "ranging":
            at = (self.scene.sensor(self.name, "ranging") or {}).get("position_m") or (0.0, 0.0, 0.0)
            self.clouds.ranging(e, f"{self.at}/body/ranging", at)

    def told(self, e):
        """A line of the run's own log, which from then on takes the place of ours."""
        self.tells = True
        self._log(e.t_s, e.text, "WARN" if e.warning else "INFO")

    def decided(self, t_s, words, level="INFO"):
        """A line in the log, unless the run writes one itself."""
        if not self.tells:
            self._log(t_s, words, level)

    def _log(self, t_s, words, level):
        self.canvas.at(t_s, self.log, rr.TextLog(f"{t_s:8.1f} s  {words}", level=level))

    def _here(self):
        if self.true is None:
            return ""
        east, north = (self.scene.origin + self.true)[:2]
        digits = 0 if self.scene.size_m() > 50.0 else 2
        return f", {east:.{digits}f} m east {north:.{digits}f} m north"

    def end(self, t_s):
        """Draws what waits."""
        self.track.end(t_s)
        self.belief.end(t_s)

    def _chart(self, t_s, name, words, value, color):
        path = f"{self.plots}/{name}"
        if path not in self.lines:
            self.lines.add(path)
            if len(self.scene.machines) > 1:
                # Beside those of other machines, a line says whose it is.
                words = f"{self.name} {words}"
                if name in ("reading/volts", "map/entropy", "height/vehicle"):
                    color = self.color
            self.canvas.line(path, words, color)
        self.canvas.scalar(t_s, path, value)

    def _state(self, t_s, name, state):
        # None is a gap in the lane. The archetype by itself takes only texts.
        self.canvas.at(t_s, f"{self.states}/{name}", rr.StateChange(state=pa.array([state], pa.utf8())))
