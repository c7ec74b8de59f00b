"""Draws the bodies of machines from the links and joints of their descriptions, and moves their joints."""

import numpy as np
import rerun as rr

from . import colours, scene, shapes, turns
from .canvas import mesh

_STILL = np.array([0.0, 0.0, 0.0, 1.0])


class Body:
    """One machine's body: entities of its links below `path`, in the order of the joints."""

    def __init__(self, canvas, path, machine):
        self.canvas = canvas
        self.machine = machine
        self.gantry = machine.get("kind") == "gantry"
        joints = machine.get("joints") or []
        self.joints = {j["name"]: j for j in joints}
        self.paths = self._paths(path, joints)
        self.turned = {}
        self._spun_s = {}
        for name, joint in self.joints.items():
            canvas.still(
                self._of_joint(joint), rr.Transform3D(translation=self._rest(joint)[0], quaternion=self._rest(joint)[1])
            )
        for link in machine.get("links") or []:
            self._link(link)
        self.drives = {}
        for drive in machine.get("drives") or []:
            self.drives.setdefault(drive["actuator"], []).append(drive)

    def _paths(self, path, joints):
        above = {j["child"]: j["parent"] for j in joints}
        paths = {}

        def place(link, depth=0):
            if link not in paths:
                parent = above.get(link)
                part = rr.escape_entity_path_part(link)
                paths[link] = f"{place(parent, depth + 1) if parent and depth < 50 else path}/{part}"
            return paths[link]

        for link in self.machine.get("links") or []:
            place(link["name"])
        for joint in joints:
            place(joint["child"])
        return paths

    def _of_joint(self, joint):
        return self.paths[joint["child"]]

    @staticmethod
    def _rest(joint):
        position = np.asarray(joint.get("position_m") or (0, 0, 0), float)
        return position, np.asarray(joint.get("quaternion_xyzw") or _STILL, float)

    def _link(self, link):
        path = self.paths[link["name"]]
        for k, shape in enumerate(link.get("shapes") or []):
            at = f"{path}/shape_{k}"
            self.canvas.still(
                at,
                mesh(solid(shape, f"{link['name']}.shapes[{k}]"), self._color(link["name"], shape)),
                rr.Transform3D(translation=shape.get("position_m"), quaternion=shape.get("quaternion_xyzw")),
            )

    def _color(self, link, shape):
        if shape.get("color"):
            return colours.from_unit(shape["color"])
        if self.gantry:
            return colours.PROBE if "probe" in link else colours.GANTRY
        moving = any(j["child"] == link and j["kind"] != "fixed" for j in self.joints.values())
        return colours.FIN if moving else colours.HULL

    def actuator(self, t_s, name, value):
        """Moves the joints that an actuator drives; a propeller turns on by its speed since the last time."""
        for drive in self.drives.get(name, ()):
            joint = self.joints.get(drive["joint"])
            if joint is None or not np.isfinite(value):
                continue
            if drive.get("unit") in ("rpm", "1/min"):
                last = self._spun_s.get(joint["name"], t_s)
                self._spun_s[joint["name"]] = t_s
                turned = self.turned.get(joint["name"], 0.0) + value / 60.0 * 2.0 * np.pi * max(0.0, t_s - last)
                value = self.turned[joint["name"]] = turned % (2.0 * np.pi)
            self.move(t_s, joint["name"], value)

    def move(self, t_s, name, value):
        """Sets a joint, m or rad."""
        joint = self.joints.get(name)
        if joint is None:
            return
        position, turn = self._rest(joint)
        axis = np.asarray(joint.get("axis") or (1, 0, 0), float)
        if joint["kind"] == "prismatic":
            position = position + turns.turn(turn, axis) * value
        elif joint["kind"] in ("revolute", "continuous"):
            turn = turns.times(turn, turns.about(axis, value))
        self.canvas.pose(t_s, self._of_joint(joint), position, turn)


def solid(shape, where):
    """The triangles of a shape of the scene document."""
    kind = shape["kind"]
    if kind == "box":
        return shapes.box(shape["size_m"])
    if kind == "cylinder":
        return shapes.cylinder(shape["radius_m"], shape["length_m"])
    if kind == "capsule":
        return shapes.capsule(shape["radius_m"], shape["length_m"])
    if kind == "sphere":
        return shapes.sphere(shape["radius_m"])
    if kind == "mesh":
        return shapes.flat(*scene.mesh(shape, where))
    raise scene.LookError(f"scene.json: {where}.kind is {kind!r}; known are box, cylinder, capsule, sphere, mesh.")
