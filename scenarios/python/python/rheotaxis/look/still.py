"""Draws what stands still: bed, surface, area, solids, interfaces."""

import numpy as np
import rerun as rr

from . import colours, shapes
from .canvas import mesh

#: Solids with more triangles than these are lit smoothly as they come.
SHARP = 20_000


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
        if len(triangles) <= SHARP:
            drawn = mesh(shapes.flat(scene.local(vertices), triangles), color)
        else:
            drawn = rr.Mesh3D(vertex_positions=scene.local(vertices), triangle_indices=triangles, albedo_factor=color)
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
