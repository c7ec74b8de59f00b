"""Draws live runs, one recording of the viewer for each."""

import time

import rerun as rr

from . import scene as scenes
from .convert import APPLICATION
from .drawing import Drawing
from .events import Cloud, Ended, Picture, Place, Pose, SceneSaid, Words
from .layout import blueprint, plan_of

#: Shortest time between two pieces of a track and between two clouds, s of simulated time.
PIECE_S, CLOUD_S = 1.0, 2.0


class Runs:
    """The run that is drawn, and how it began."""

    def __init__(self, target, to_file, truth, view):
        self.target, self.to_file, self.truth, self.view = target, to_file, truth, view
        self.stream = self.drawing = self.plan = None
        self.said = None
        self.last_s = 0.0
        self.clouds = {}

    def draw(self, batch):
        """Draws events; a scene begins a new recording."""
        for e in batch:
            if isinstance(e, SceneSaid):
                self.end()
                self.said, self.last_s, self.clouds = e, 0.0, {}
                if e.document:
                    self._begin(scenes.read(e.document), [])
            elif self.drawing is None:
                if self.said is not None and isinstance(e, (Pose, Place)):
                    line = "the run says no scene (it is of an older version): no bed, bodies, solids and sources."
                    self._begin(scenes.without_document([e.position], self.said.run), [line])
            if self.drawing is not None and not isinstance(e, SceneSaid):
                self._one(e)
        if self.drawing is not None:
            self.drawing.canvas.flush()

    def _one(self, e):
        if isinstance(e, Cloud) and e.name in ("plume", "water", "map"):
            if e.t_s < self.clouds.get(e.slot(), float("-inf")) + CLOUD_S:
                return
            self.clouds[e.slot()] = e.t_s
        if not isinstance(e, Ended):
            self.last_s = max(self.last_s, e.t_s)
        self._grow(e)
        self.drawing.event(e)

    def _grow(self, e):
        """Lays out anew when a map, pictures, layers or a machine show up that the scene did not name."""
        plan = self.plan
        more = {
            "map": plan.map or (isinstance(e, Cloud) and e.name == "map"),
            "pictures": plan.pictures or isinstance(e, Picture),
            "layers": plan.layers or (isinstance(e, Words) and e.name == "layers"),
        }
        known = set(plan.robots + plan.gantries)
        names = known | ({e.machine} if e.machine else set())
        if names == known and all(getattr(plan, k) == v for k, v in more.items()):
            return
        self.plan = plan_of(self.drawing.scene, sorted(names), live=True, **more)
        if self.drawing.scene.machines and names != known:
            self.plan.robots = [*plan.robots, *(n for n in names if n not in known)]
        rr.send_blueprint(blueprint(self.plan, self.view), recording=self.stream)

    def _begin(self, scene, missing):
        name = self.said.run or scene.run or "run"
        # A run that is made again is another recording.
        self.stream = rr.RecordingStream(APPLICATION, recording_id=f"{name}-{time.time_ns() // 1_000_000}")
        self.plan = plan_of(scene, [], live=True)
        if self.to_file:
            self.stream.save(str(self.target), default_blueprint=blueprint(self.plan, self.view))
        else:
            self.stream.connect_grpc(self.target, default_blueprint=blueprint(self.plan, self.view))
        self.stream.send_recording_name(name)
        self.drawing = Drawing(self.stream, scene, self.truth, PIECE_S, missing)

    def end(self):
        """Draws what waits and closes the recording."""
        if self.drawing is not None:
            self.drawing.end(self.last_s)
            self.stream.disconnect()
            self.drawing = self.stream = None
