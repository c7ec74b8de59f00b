"""Turns events into what the viewer shows: the run as a whole, and the parts that several machines share."""

import numpy as np
import rerun as rr

from . import colours, legend, still
from .canvas import Canvas
from .clouds import Clouds
from .events import Cloud, Declared, Ended, Marks, Number, Picture, Place, Pose, Said, SceneSaid, Way, Words
from .machine import Machine


class Drawing:
    """Draws one run onto a stream.

    `truth` shows the true sources from the beginning; otherwise one shows when something is declared. `period_s` is the
    time between two pieces of a track.
    """

    def __init__(self, stream, scene, truth=False, period_s=1.0, missing=()):
        self.canvas = Canvas(stream)
        self.scene = scene
        self.period_s = period_s
        self.clouds = Clouds(self.canvas, scene)
        self.machines = {}
        self.shown = set()
        self.missing = list(missing)
        self.began = False
        still.draw(self.canvas, scene)
        for name in scene.machines:
            self.machine(name)
        if truth:
            self._truth(None)
        self.legend()

    def legend(self):
        """Writes the legend anew."""
        said = legend.text(self.scene, self.clouds.said, self.missing)
        self.canvas.still("legend", rr.TextDocument(said, media_type=rr.MediaType.MARKDOWN))

    def machine(self, name):
        """The drawing of a machine, begun if need be."""
        if name not in self.machines:
            self.machines[name] = Machine(self.canvas, self.scene, self.clouds, name, len(self.machines), self.period_s)
        return self.machines[name]

    def event(self, e):
        """Draws an event."""
        if isinstance(e, Cloud) and e.machine is None:
            said = dict(self.clouds.said)
            if e.name == "plume":
                self.clouds.plume(e)
            elif e.name == "water":
                self.clouds.water(e)
            if said != self.clouds.said:
                self.legend()
            return
        if isinstance(e, (SceneSaid, Ended)):
            return
        machine = self.machine(e.machine)
        if isinstance(e, Declared):
            machine.declared(e)
            self._truth(e.t_s)
            return
        kinds = {
            Pose: machine.pose,
            Number: machine.number,
            Words: machine.words,
            Place: machine.place,
            Way: machine.way,
            Marks: machine.marks,
            Picture: machine.picture,
            Cloud: machine.cloud,
            Said: machine.told,
        }
        draw = kinds.get(type(e), machine.joints)
        draw(e)

    def end(self, t_s):
        """Draws what waits for more."""
        for machine in self.machines.values():
            machine.end(t_s)
        self.canvas.flush()

    def _truth(self, t_s):
        for n, source in enumerate(self.scene.sources):
            if n in self.shown:
                continue
            self.shown.add(n)
            at = self.scene.local(source["position"])
            path = f"world/truth/source_{n}"
            # Beside a declaration its label would cover that of the declaration.
            label = [f"source {source['name']}"] if t_s is None else None
            stake = np.array([at, [at[0], at[1], max(0.0, at[2])]])
            color = [colours.TRUTH]
            for part, thing in (
                ("point", rr.Points3D([at], colors=color, radii=[rr.Radius.ui_points(6)], labels=label)),
                ("stake", rr.LineStrips3D([stake], colors=color, radii=[rr.Radius.ui_points(1.2)])),
            ):
                if t_s is None:
                    self.canvas.still(f"{path}/{part}", thing)
                else:
                    self.canvas.at(t_s, f"{path}/{part}", thing)
