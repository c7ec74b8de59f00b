"""Takes a picture of the viewer's page once it is drawn."""

import io
import time
from pathlib import Path

import numpy as np
from PIL import Image

from . import colours
from .chromium import Chromium
from .errors import LookError

#: Longest time until the page is drawn, on a loaded machine without a graphics card, s.
PATIENCE_S = 240.0
#: Share of pixels that may still change in a page that stands.
STILL = 0.002


def pixels(png):
    """A picture as an array (height, width, 3)."""
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)


def drawn(image):
    """Whether a 3D view with something in it is there: its background shows, and colours beside it."""
    background = np.abs(image - colours.BACKGROUND).max(axis=2) <= 1
    colourful = (image.max(axis=2) - image.min(axis=2) > 24) & (image.max(axis=2) > 60)
    return background.mean() > 0.02 and colourful.mean() > 0.002


def take(address, size, still=True, ready=lambda: True, patience_s=PATIENCE_S):
    """A picture (PNG) of the page at `address`, once it is drawn and, if `still`, no longer changes.

    `ready` says whether all data is there.
    """
    deadline = time.monotonic() + patience_s
    with Chromium(*size) as browser:
        browser.open(address)
        before = problem = None
        while time.monotonic() < deadline:
            time.sleep(1.0)
            ready_now = ready()
            try:
                png = browser.picture()
            except LookError as e:
                # While a page takes the place of another there is nothing to take a picture of.
                problem, before = e, None
                continue
            image = pixels(png)
            if ready_now and drawn(image):
                if not still and before is not None:
                    return png
                if before is not None and (np.abs(image - before).max(axis=2) > 8).mean() < STILL:
                    return png
                before = image
            else:
                before = None
    why = f" ({problem})" if problem else ""
    raise LookError(f"the page was not drawn within {patience_s:.0f} s{why}. Is the machine busy, or short of memory?")


def write(path, png):
    """Writes a picture; a file that is there is replaced once the new one is whole."""
    path = Path(path)
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(png)
        part.replace(path)
    except OSError as e:
        part.unlink(missing_ok=True)
        raise LookError(f"{path}: cannot be written ({e.strerror}).") from e
