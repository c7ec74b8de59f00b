"""What a user may ask for on the command line."""

import argparse
import math
import re

from .layout import VIEWS

TEXT = """\
Shows a mission in three dimensions in the Rerun viewer: vehicle or gantry, bed, obstacles, water, plume, tracks, what
the searcher believes, readings, behaviour and decisions, over simulated time.

  python -m rheotaxis.look                       follow a run that goes on here, or the next one that starts
  python -m rheotaxis.look runs/duck_st-1        replay a finished run from its recording (or name a run.mcap)
  python -m rheotaxis.look runs/duck_st-1 --web  the same in a browser: open the printed address
  python -m rheotaxis.look runs/duck_st-1 --picture duck.png --at 600
                                                 a picture of the scene 600 s into the mission
  python -m rheotaxis.look runs/duck_st-1 --save duck.rrd
                                                 a file for the viewer, to send or to keep: `rerun duck.rrd`
"""

MORE = """\
In the viewer: drag to turn, right drag to shift, wheel to zoom, double click on a thing to go there. The bar below is
simulated time: drag it, or press space. The tab Legend says what colours and sizes mean.

Without a display, and without --web, --save or --picture, the page is served as with --web. The page and its data are
served on 127.0.0.1 only: from another machine, use a tunnel (ssh -L 9090:127.0.0.1:9090 -L 9876:127.0.0.1:9876 HOST).
A stalled or closed viewer never holds back a run. Ctrl-C ends the look and not the run.

Exit code: 0; 1 if something went wrong, or the recording is cut off (what can be read is shown); 2 on wrong usage.
"""


def memory(text):
    """A size such as 512MB, 2GiB or 25%."""
    if not re.fullmatch(r"\d+(\.\d+)?(kB|MB|GB|KiB|MiB|GiB|%)", text) or float(re.match(r"[\d.]+", text)[0]) == 0.0:
        raise argparse.ArgumentTypeError(
            f"{text!r} is no size: write for example 512MB, 2GiB or 25%%".replace("%%", "%")
        )
    return text


def seconds(text):
    """A time that is not negative, s."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value >= 0.0):
        raise argparse.ArgumentTypeError(f"{text!r} is no time in seconds from 0 on")
    return value


def port(text):
    """A port that a user may listen on."""
    if not text.isdigit() or not 1024 <= int(text) <= 65535:
        raise argparse.ArgumentTypeError(f"{text!r} is no port from 1024 to 65535")
    return int(text)


def size(text):
    """Width and height of a picture, pixels."""
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if not match or not all(200 <= int(n) <= 4096 for n in match.groups()):
        raise argparse.ArgumentTypeError(f"{text!r} is no size: write for example 1600x900, each from 200 to 4096")
    return int(match[1]), int(match[2])


def parser():
    """The parser of the command line."""
    p = argparse.ArgumentParser(
        prog="python -m rheotaxis.look",
        description=TEXT,
        epilog=MORE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    p.add_argument("recording", nargs="?", help="a run's folder or its run.mcap; without it, a live run is followed")
    how = p.add_argument_group("where it shows").add_mutually_exclusive_group()
    how.add_argument("--web", action="store_true", help="serve a page on 127.0.0.1 instead of opening a window")
    how.add_argument("--save", metavar="FILE.rrd", help="write a file for the viewer; a live run until its end")
    how.add_argument("--picture", metavar="FILE.png", help="take a picture with headless Chromium")
    what = p.add_argument_group("what it shows")
    what.add_argument("--truth", action="store_true", help="show the true sources before anything is declared")
    what.add_argument(
        "--at", type=seconds, metavar="S", help="show up to this simulated time, s (default: all; live: now)"
    )
    what.add_argument("--view", choices=VIEWS, default="all", help="all panels (default), or one view alone")
    what.add_argument("--size", type=size, default=(1600, 900), metavar="WxH", help="of a picture (default 1600x900)")
    live = p.add_argument_group("live runs")
    live.add_argument("--run", metavar="NAME", help="the run to follow, such as duck_st_1 (default: the newest)")
    live.add_argument(
        "--connect", metavar="ENDPOINT", help="where it is (tcp/HOST:PORT), or a zenoh configuration (.json5)"
    )
    live.add_argument("--wait", type=seconds, metavar="S", help="give up if no run is there by then (default: wait)")
    tuning = p.add_argument_group("resources")
    tuning.add_argument(
        "--memory",
        type=memory,
        default="1GiB",
        metavar="SIZE",
        help="most memory of the viewer's data (default 1GiB); beyond it the oldest is dropped",
    )
    tuning.add_argument(
        "--web-port", type=port, metavar="PORT", help="of the page (default: 9090 or the next free one)"
    )
    tuning.add_argument(
        "--data-port", type=port, metavar="PORT", help="of its data (default: 9876 or the next free one)"
    )
    return p


def read(words=None):
    """The options of a command line."""
    p = parser()
    options = p.parse_args(words)
    if options.recording and (options.run or options.connect or options.wait is not None):
        p.error("--run, --connect and --wait are for live runs, not for a recording")
    if not options.recording and options.at is not None and not options.picture:
        p.error("--at needs a recording, or --picture")
    return options
