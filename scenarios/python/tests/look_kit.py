"""What the tests of the look share: a small recording made by the package itself, and pictures judged by content."""

import struct
from pathlib import Path

import numpy as np


def cut(source, target, share):
    """The first part of a file."""
    data = Path(source).read_bytes()
    Path(target).write_bytes(data[: int(share * len(data))])


def near(image, color, within=40):
    """Share of pixels near a colour."""
    return float((np.abs(image - np.array(color)).max(axis=2) <= within).mean())


def chromium():
    """Whether Chromium can be had."""
    from rheotaxis.look.chromium import find

    return find() is not None


def cdr_float64(value):
    """A `std_msgs/Float64`."""
    return struct.pack("<4Bd", 0, 1, 0, 0, value)
