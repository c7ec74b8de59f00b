"""Shows a recording: window, page, file or picture."""

import shutil
import sys
import tempfile
from pathlib import Path

from . import contents, picture
from .convert import convert
from .errors import LookError
from .viewer import Viewer, has_display


def show(options):
    """Shows the recording that the options name; returns the exit code."""
    source = contents.find(options.recording)
    if options.save:
        whole = save(source, options.save, options)
        print(f"{options.save}: written. Open it with: rerun {options.save}")
        return 0 if whole else 1
    with tempfile.TemporaryDirectory(prefix="rheotaxis-look-") as folder:
        drawn = Path(folder) / "run.rrd"
        print(f"{source}: drawing ...", file=sys.stderr)
        whole, last_s = convert(source, drawn, options.truth, options.at, complain, options.view)
        enough(folder)
        web = bool(options.web or options.picture or not has_display())
        with Viewer(web, options.memory, [drawn], options.web_port, options.data_port) as viewer:
            if options.picture:
                png = picture.take(viewer.page, options.size, until_s=last_s, alive=viewer.alive)
                picture.write(options.picture, png)
                print(f"{options.picture}: written.")
            else:
                stay(viewer)
    return 0 if whole else 1


def save(source, target, options):
    """Draws a recording into a file; one that is there is replaced once the new one is whole."""
    target = Path(target)
    if target.exists() and not target.is_file():
        raise LookError(f"{target}: this is no regular file. Name another one.")
    if not target.parent.is_dir():
        raise LookError(f"{target}: the folder {target.parent} does not exist.")
    part = target.with_name(target.name + ".part")
    try:
        # The viewer's library does not say when it cannot write, so that is tried before, and room looked for after.
        part.write_bytes(b"")
        whole, _ = convert(source, part, options.truth, options.at, complain, options.view)
        enough(target.parent)
        part.replace(target)
    except OSError as e:
        raise LookError(f"{target}: cannot be written ({e.strerror}).") from e
    finally:
        part.unlink(missing_ok=True)
    return whole


def enough(folder):
    """Complains if the disk has filled up while a file was written."""
    if shutil.disk_usage(folder).free < 1 << 20:
        raise LookError(f"{folder}: the disk is full. Free some room, or name a folder on another disk.")


def stay(viewer):
    """Waits until the viewer is closed or the user ends."""
    if viewer.web_port is not None:
        print(f"Open {viewer.page}", flush=True)
        print("Ctrl-C ends.", file=sys.stderr)
    viewer.process.wait()


def complain(line):
    """A line for the user beside the result."""
    print(f"note: {line}", file=sys.stderr)
