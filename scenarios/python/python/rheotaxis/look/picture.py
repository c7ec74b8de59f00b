"""Takes a picture of the viewer's page once it is drawn."""

import io
import time
from pathlib import Path

import numpy as np
from PIL import Image

from . import colours, page
from .chromium import Chromium
from .errors import EndedError, LookError

#: Longest time in which the page comes no further, on a loaded machine without a graphics card, s.
PATIENCE_S = 240.0
#: Time between two looks at the page, s.
PAUSE_S = 1.0
#: What may be missing at the end of a run, s: the viewer gets its data in pieces.
SLACK_S = 0.5
#: Pictures of a page that has the whole run and shows it, of which the last is taken even if it moves.
MOST_TRIES = 10
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


def take(address, size, still=True, until_s=None, alive=lambda: True, patience_s=PATIENCE_S):
    """A picture (PNG) of the page at `address`, once it has drawn the run.

    That is once the page has the run up to `until_s`, a view shows something of it, and, if `still`, two pictures in
    a row are alike. `alive` says whether the viewer behind the page is there. Each of these steps may take `patience_s`
    since the page last came further.
    """
    with Chromium(*size) as browser:
        browser.open(address)
        step, began, before, tries = None, time.monotonic(), None, 0
        while True:
            time.sleep(PAUSE_S)
            if not alive():
                raise EndedError("the viewer ended by itself. Is the machine short of memory?")
            try:
                now, png = page.read(browser), browser.picture()
            except EndedError:
                raise
            except LookError as e:
                # While a page takes the place of another there is nothing to take a picture of.
                now, png, missing = page.Page(), None, str(e)
            else:
                missing = _missing(now, until_s)
            if now.failure:
                raise LookError(f"the viewer's page says: {now.failure}")
            image = None if missing else pixels(png)
            if image is not None and not drawn(image):
                image, missing = None, "the page has the run, but no view shows anything of it"
            if image is not None and before is not None:
                tries += 1
                alike = (np.abs(image - before).max(axis=2) > 8).mean() < STILL
                # What moves although all is there, such as a mark that blinks, is no reason to wait for ever.
                if alike or not still or tries >= MOST_TRIES:
                    return png
            before = image
            if (missing, now.until_s) != step:
                step, began = (missing, now.until_s), time.monotonic()
            elif missing and time.monotonic() - began > patience_s:
                raise LookError(f"no picture, and no progress for {patience_s:.0f} s: {missing}.")


def _missing(now, until_s):
    """What a page lacks that it must have before it can show the run, or None."""
    if not now.runs:
        return "the page has not started the viewer; is the machine busy, or short of memory?"
    if until_s is not None and now.until_s is not None and now.until_s < until_s - SLACK_S:
        has = "nothing of the run" if now.until_s == float("-inf") else f"the run up to {now.until_s:.1f} s"
        return f"the page has {has}, of {until_s:.1f} s"
    return None


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
