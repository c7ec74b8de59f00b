"""The scene of a run: what stands still, and what its machines look like.

It is read from the document `scene.json` that a recording carries and a live run says under `meta/scene`. Arrays are
base64 of little-endian 32-bit numbers. All is in the world's axes (east, north, up) in m.
"""

import base64
import binascii
import json
import math
from dataclasses import dataclass, field

import numpy as np

from .errors import LookError

#: Version of the document that this module reads.
VERSION = 2


@dataclass
class Scene:
    """What a run's scene holds; empty where the run does not say."""

    run: str = ""
    scenario: str = ""
    title: str = ""
    corners: np.ndarray | None = None  # (4, 2)
    bed: np.ndarray | None = None  # (rows, columns, 3)
    surface: bool = True
    solids: list = field(default_factory=list)
    sources: list = field(default_factory=list)
    layers: list = field(default_factory=list)
    machines: dict = field(default_factory=dict)
    #: Subtracted from east and north before drawing, because the viewer computes in 32 bits.
    origin: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def local(self, points):
        """Points relative to the scene's origin, as the viewer gets them."""
        return np.asarray(points, np.float64) - self.origin[: np.shape(points)[-1]]

    def kind(self, machine):
        """`robot`, `gantry` or an empty text if the scene does not say."""
        return self.machines.get(machine, {}).get("kind", "")

    def sensor(self, machine, kind):
        """The first sensor of a kind on a machine, or None."""
        sensors = self.machines.get(machine, {}).get("sensors") or []
        return next((s for s in sensors if s.get("kind") == kind), None)

    def size_m(self):
        """Length of the area's diagonal, m; 100 where the area is not known."""
        if self.corners is None or len(self.corners) == 0:
            return 100.0
        return float(np.linalg.norm(np.ptp(self.corners, axis=0)))

    def depth_m(self):
        """Greatest depth of the bed, m; 0 where it is not known."""
        return 0.0 if self.bed is None else float(max(0.0, -np.nanmin(self.bed[..., 2])))


def array(text, kind, width, where):
    """A base64 array of little-endian numbers (`<f4` or `<u4`) as rows of `width`."""
    try:
        numbers = np.frombuffer(base64.b64decode(text, validate=True), kind)
    except (binascii.Error, ValueError, TypeError) as e:
        raise LookError(f"scene.json: {where} is not base64 of 32-bit numbers ({e}).") from e
    if numbers.size % width:
        raise LookError(f"scene.json: {where} holds {numbers.size} numbers, which are no rows of {width}.")
    return numbers.reshape(-1, width)


def mesh(solid, where):
    """Vertices (n, 3) and triangles (m, 3) of a solid or a mesh shape."""
    vertices = array(solid["vertices_m"], "<f4", 3, f"{where}.vertices_m").astype(np.float64)
    triangles = array(solid["triangles"], "<u4", 3, f"{where}.triangles")
    if triangles.size and triangles.max() >= len(vertices):
        raise LookError(f"scene.json: {where}.triangles names vertex {triangles.max()} of {len(vertices)}.")
    if not np.isfinite(vertices).all():
        raise LookError(f"scene.json: {where}.vertices_m holds numbers that are not finite.")
    return vertices, triangles


def read(document):
    """The scene of a document (bytes of JSON)."""
    try:
        said = json.loads(document)
        if said["version"] != VERSION:
            raise LookError(f"scene.json is of version {said['version']}, this program reads version {VERSION}.")
        return _read(said)
    except (json.JSONDecodeError, UnicodeDecodeError) as e:
        raise LookError(f"scene.json is no JSON: {e}.") from e
    except (KeyError, TypeError, AttributeError, ValueError) as e:
        raise LookError(f"scene.json lacks or mistypes a field: {type(e).__name__} {e}.") from e


def _read(said):
    scene = Scene(run=said.get("run", ""), scenario=said.get("scenario", ""), title=said.get("title", ""))
    corners = (said.get("area") or {}).get("corners_m")
    if corners:
        scene.corners = np.asarray(corners, np.float64).reshape(-1, 2)
    centre = np.array([*said["origin_m"], 0.0])
    if said.get("bed"):
        rows, columns = said["bed"]["shape"]
        points = array(said["bed"]["points_m"], "<f4", 3, "bed.points_m").astype(np.float64)
        if len(points) != rows * columns:
            raise LookError(f"scene.json: bed.points_m holds {len(points)} points, bed.shape {rows} x {columns}.")
        scene.bed = points.reshape(rows, columns, 3) + centre
    scene.surface = bool(said.get("surface", True))
    for n, solid in enumerate(said.get("solids") or []):
        vertices, triangles = mesh(solid, f"solids[{n}]")
        color = solid.get("color") or [0.5, 0.5, 0.5, 1.0]
        scene.solids.append({"name": solid.get("name") or str(n), "color": color, "mesh": (vertices + centre, triangles)})
    scene.sources = [
        {"name": s["name"], "position": np.asarray(s["position_m"], float)} for s in said.get("sources") or []
    ]
    scene.layers = [{"name": x.get("name", ""), "z_m": float(x["z_m"])} for x in said.get("layers") or []]
    scene.machines = {m["id"]: m for m in said.get("machines") or []}
    if scene.corners is not None:
        low = np.floor(scene.corners.min(axis=0))
        scene.origin = np.array([low[0], low[1], 0.0])
    return scene


def without_document(points, run=""):
    """A scene for a run that says none: its origin lies near where the run happens (`points`: east, north, ...)."""
    scene = Scene(run=run)
    points = np.asarray(points, np.float64).reshape(-1, np.shape(points)[-1] if np.size(points) else 3)
    points = points[np.isfinite(points).all(axis=1)]
    if len(points):
        low, high = points.min(axis=0), points.max(axis=0)
        step = 100.0 if np.linalg.norm(high - low) > 50.0 else 1.0
        scene.origin = np.array([step * math.floor(low[0] / step), step * math.floor(low[1] / step), 0.0])
        scene.corners = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
        scene.surface = False
    return scene
