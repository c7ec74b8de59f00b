"""Draws what stands still: bed, surface, area, solids, interfaces."""

import numpy as np
import rerun as rr

from . import colours, shapes
from .canvas import mesh

#: Solids with more triangles than these are lit smoothly as they come.
SHARP = 20_000
#: Solids with more triangles than these are shapes from files, which are darker the lower a place is.
RELIEF = 500
#: Height by which solids are drawn higher, as a share of the scene: where a mound runs out on the bed, both lie in one
#: plane, and a viewer shows patches of either.
LIFT = 2e-4


def draw(canvas, scene):
    """Draws the scene without its machines."""
    canvas.still("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP)
    if scene.bed is not None:
        _bed(canvas, scene)
    if scene.corners is not None and len(scene.corners) >= 3:
        corners = scene.local(scene.corners)
        ring = np.column_stack([np.vstack([corners, corners[:1]]), np.zeros(len(corners) + 1)])
        canvas.still("world/area", rr.LineStrips3D([ring], colors=[colours.OUTLINE], radii=[rr.Radius.ui_points(1.0)]))
        if scene.surface:
            canvas.still("world/surface", mesh(shapes.polygon(corners, 0.0), colours.SURFACE))
        for n, layer in enumerate(scene.layers):
            sheet = shapes.polygon(corners, layer["z_m"])
            canvas.still(f"world/layers/interface_{n}", mesh(sheet, colours.INTERFACE))
            edge = ring + [0.0, 0.0, layer["z_m"]]
            lines = rr.LineStrips3D([edge], colors=[colours.INTERFACE[:3]], radii=[rr.Radius.ui_points(0.6)])
            canvas.still(f"world/layers/edge_{n}", lines)
    for n, solid in enumerate(scene.solids):
        vertices, triangles = solid["mesh"]
        if len(triangles) == 0:
            continue
        color = colours.from_unit(solid["color"])
        vertices = scene.local(vertices) + [0.0, 0.0, LIFT * scene.size_m()]
        if len(triangles) <= RELIEF:
            drawn = mesh(shapes.flat(vertices, triangles), color)
        else:
            drawn = _relief(vertices, triangles, color)
        canvas.still(f"world/solids/{rr.escape_entity_path_part(solid['name'])}_{n}", drawn)


def _bed(canvas, scene):
    grid = scene.local(scene.bed)
    z = grid[..., 2].ravel()
    # From the surface, or the highest point of land, to the deepest place.
    deep, high = np.nanmin(z), min(0.0, np.nanmax(z))
    spread = max(high - deep, 1e-6)
    share = (high - z) / spread
    if np.nanmax(z) - deep < 0.02 * abs(deep):
        # A flat bed has one colour, of the middle of the scale, on which plume and tracks are easy to see.
        share = np.full(z.shape, 0.55)
    points, triangles, normals = shapes.sheet(grid)
    canvas.still(
        "world/bed",
        rr.Mesh3D(
            vertex_positions=points.astype(np.float32),
            triangle_indices=triangles.astype(np.uint32),
            vertex_normals=normals.astype(np.float32),
            vertex_colors=colours.shade(share, "bed"),
        ),
    )


def _relief(vertices, triangles, color):
    """A solid whose colour follows its height."""
    normals = None
    if len(triangles) <= SHARP:
        vertices, triangles, normals = shapes.flat(vertices, triangles)
    z = np.asarray(vertices)[:, 2]
    share = (z - z.min()) / max(np.ptp(z), 1e-9)
    shades = np.clip(np.outer(0.6 + 0.6 * share, color[:3]), 0, 255).astype(np.uint8)
    return rr.Mesh3D(
        vertex_positions=vertices, triangle_indices=triangles, vertex_normals=normals, vertex_colors=shades
    )
