"""Triangles with normals of the shapes that a body's description uses, in the shape's own axes, m."""

import numpy as np

#: Corners of a round shape's outline.
AROUND = 24


def flat(vertices, triangles):
    """Vertices, triangles and normals with each face lit by itself, so that edges stay sharp."""
    corners = np.asarray(vertices, float)[np.asarray(triangles, int)]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    normals = np.divide(across, length, out=np.zeros_like(across), where=length > 0)
    points = corners.reshape(-1, 3)
    return points, np.arange(len(points)).reshape(-1, 3), np.repeat(normals, 3, axis=0)


def box(size):
    """A box about its middle."""
    x, y, z = (0.5 * s for s in size)
    v = [(i, j, k) for i in (-x, x) for j in (-y, y) for k in (-z, z)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return flat(v, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def turned(profile):
    """A shape turned about z from rows of radius and height, upwards; smooth along and around."""
    rows = np.asarray(profile, float)
    angle = np.linspace(0.0, 2.0 * np.pi, AROUND, endpoint=False)
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    slope = np.gradient(rows, axis=0)
    out, up = slope[:, 1], -slope[:, 0]
    size = np.hypot(out, up)
    size[size == 0] = 1.0
    points = [np.column_stack([r * around, np.full(AROUND, z)]) for r, z in rows]
    normals = [np.column_stack([o * around, np.full(AROUND, u)]) for o, u in zip(out / size, up / size)]
    triangles = []
    for k in range(len(rows) - 1):
        low, high = k * AROUND, (k + 1) * AROUND
        for i in range(AROUND):
            j = (i + 1) % AROUND
            triangles += [(low + i, low + j, high + j), (low + i, high + j, high + i)]
    return np.concatenate(points), np.array(triangles), np.concatenate(normals)


def joined(*parts):
    """Several shapes as one."""
    points, triangles, normals, first = [], [], [], 0
    for p, t, n in parts:
        points.append(p)
        triangles.append(np.asarray(t) + first)
        normals.append(n)
        first += len(p)
    return np.concatenate(points), np.concatenate(triangles), np.concatenate(normals)


def cylinder(radius, length):
    """A cylinder along z about its middle, with flat ends."""
    h = 0.5 * length
    side = turned([(radius, -h), (radius, h)])
    ends = turned([(0.0, h), (radius, h)]), turned([(radius, -h), (0.0, -h)])
    up = np.array([0.0, 0.0, 1.0])
    top = (ends[0][0], ends[0][1][:, ::-1], np.tile(up, (len(ends[0][0]), 1)))
    bottom = (ends[1][0], ends[1][1][:, ::-1], np.tile(-up, (len(ends[1][0]), 1)))
    return joined(side, top, bottom)


def capsule(radius, length):
    """A cylinder of `length` along z about its middle, with half a sphere at either end."""
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 17)
    z = radius * np.sin(angle) + np.where(angle < 0, -0.5, 0.5) * length
    return turned(np.column_stack([radius * np.cos(angle), z]))


def sphere(radius):
    """A sphere about its middle."""
    return capsule(radius, 0.0)


def sheet(grid):
    """A grid of points (rows, columns, 3) as a smooth surface with normals upwards."""
    rows, columns = grid.shape[:2]
    k = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, 1:].ravel(), k[1:, :-1].ravel()
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    across = np.cross(np.gradient(grid, axis=1), np.gradient(grid, axis=0))
    across[across[..., 2] < 0] *= -1.0
    length = np.linalg.norm(across, axis=2, keepdims=True)
    normals = np.divide(across, length, out=np.zeros_like(across), where=length > 0)
    points = grid.reshape(-1, 3)
    kept = np.isfinite(points[triangles]).all(axis=(1, 2))
    return np.nan_to_num(points), triangles[kept], normals.reshape(-1, 3)


def polygon(corners, z):
    """A flat polygon (n, 2) at a height, as triangles from its first corner."""
    n = len(corners)
    points = np.column_stack([corners, np.full(n, z)])
    triangles = np.array([(0, i, i + 1) for i in range(1, n - 1)])
    return points, triangles, np.tile([0.0, 0.0, 1.0], (n, 1))
