"""Colours of the scene: 8-bit red, green, blue, alpha."""

import numpy as np

#: Background of 3D views, the outline of the area, and the surface of the water.
BACKGROUND, OUTLINE, SURFACE = (11, 19, 30), (150, 175, 195), (120, 190, 220, 16)
#: Robots in their order; the believed track of each has a lighter tint.
ROBOTS = [(255, 255, 255), (255, 170, 60), (120, 220, 130), (230, 130, 230), (250, 230, 90), (130, 190, 255)]
BELIEVED = (255, 150, 60)
DETECTION, LOST, DECLARED, TRUTH = (255, 235, 60), (255, 120, 120), (255, 96, 120), (80, 255, 140)
PLAN, GOAL, ZONE, INTERFACE = (120, 210, 255), (120, 210, 255), (255, 200, 80), (170, 120, 255, 14)
ECHO = (120, 255, 220)
HULL, FIN, GANTRY, PROBE = (245, 196, 40), (60, 64, 72), (150, 158, 168), (235, 90, 60)

#: Shallow to deep.
_BED = np.array([[226, 208, 164], [170, 190, 160], [86, 150, 150], [44, 98, 128], [26, 58, 96], [16, 34, 66]], float)
#: Weak to strong.
_DYE = np.array(
    [[126, 74, 190], [176, 70, 176], [222, 78, 132], [248, 118, 84], [254, 182, 92], [252, 250, 180]], float
)
#: Slow to fast.
_FLOW = np.array([[60, 96, 160], [84, 150, 190], [140, 200, 215]], float)
#: Improbable to probable.
_BELIEF = np.array([[30, 70, 90], [30, 130, 120], [110, 200, 90], [250, 240, 90]], float)
_GREY = np.array([[12, 10, 6], [120, 90, 45], [255, 225, 160]], float)
_MAPS = {"bed": _BED, "dye": _DYE, "flow": _FLOW, "belief": _BELIEF, "sonar": _GREY}


def shade(share, name):
    """Colours (n, 3) of shares 0 to 1 on a scale; what is not finite counts as 0."""
    scale = _MAPS[name]
    x = np.clip(np.nan_to_num(np.asarray(share, float)), 0.0, 1.0) * (len(scale) - 1)
    low = np.minimum(x.astype(int), len(scale) - 2)
    part = (x - low)[:, None]
    return np.rint((1.0 - part) * scale[low] + part * scale[low + 1]).astype(np.uint8)


def of_robot(n):
    """The colour of the n-th machine."""
    return ROBOTS[n % len(ROBOTS)]


def mixed(a, b, share):
    """`a` with a share of `b` in it."""
    return tuple(int(round((1 - share) * x + share * y)) for x, y in zip(a[:3], b[:3]))


def from_unit(color):
    """8-bit colour of one given as 0 to 1."""
    return tuple(int(round(255 * min(1.0, max(0.0, c)))) for c in color)
