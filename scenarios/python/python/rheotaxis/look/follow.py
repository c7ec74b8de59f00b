"""Follows live runs: window, page, file or picture."""

import sys
import threading
import time
from pathlib import Path

from . import picture
from .errors import LookError
from .events import Ended, SceneSaid
from .live import Live
from .replay import complain
from .viewer import Viewer, has_display
from .writer import Writer

#: Time that a page may take to get the last data, s.
LAST_S = 1.0


def show(options):
    """Follows the run that the options name, or the newest; returns the exit code."""
    live = Live(options.connect, options.run)
    try:
        if options.save:
            return _save(live, options)
        with Viewer(
            bool(options.web or options.picture or not has_display()),
            options.memory,
            (),
            options.web_port,
            options.data_port,
        ) as viewer:
            return _show(live, viewer, options)
    finally:
        live.close()


def _first(live, options):
    if not live.runs():
        print(f"waiting for a run{' ' + options.run if options.run else ''} ...", file=sys.stderr, flush=True)
    patience = float("inf") if options.wait is None else options.wait
    return live.wait(patience)


def _none(live, options):
    there = live.runs()
    hint = (
        f" There is: {', '.join(there)}."
        if there
        else " Start one with `rheotaxis run`, or name its endpoint with --connect."
    )
    return LookError(f"no run{' ' + options.run if options.run else ''} was found within {options.wait:g} s.{hint}")


def _begin(live, run, writer):
    said = live.follow(run)
    others = [r for r in live.runs() if r != run]
    print(
        f"following {run}" + (f" (there is also {', '.join(others)}: --run NAME)" if others else ""),
        file=sys.stderr,
        flush=True,
    )
    if not said.document:
        complain(f"{run} says no scene (it is of an older version): no bed, bodies, solids and sources.")
    writer.put(said)


def _save(live, options):
    target = Path(options.save)
    if not target.parent.is_dir() or (target.exists() and not target.is_file()):
        raise LookError(f"{target}: cannot be written: its folder does not exist, or it is no regular file.")
    run = _first(live, options)
    if run is None:
        raise _none(live, options)
    writer = Writer(str(target), True, options.truth, options.view)
    try:
        _begin(live, run, writer)
        _until_gone(live, writer, lambda: not writer.alive())
    except KeyboardInterrupt:
        pass
    whole = writer.close()
    if not whole or not target.is_file():
        raise LookError(f"{target}: could not be written to its end.")
    print(f"{target}: written. Open it with: rerun {target}")
    return 0


def _show(live, viewer, options):
    writer = Writer(viewer.data, False, options.truth, options.view)
    if options.web or (viewer.web_port and not options.picture):
        print(f"Open {viewer.page}", flush=True)
        print("Ctrl-C ends the look and not the run.", file=sys.stderr, flush=True)
    try:
        if options.picture:
            return _picture(live, viewer, writer, options)
        while viewer.alive() and writer.alive():
            run = live.wait(0.5) if options.wait is None or live.following else _first(live, options)
            if run is None:
                if options.wait is not None and not live.following:
                    raise _none(live, options)
                continue
            _begin(live, run, writer)
            _until_gone(live, writer, lambda: not (viewer.alive() and writer.alive()))
            if viewer.alive():
                print(f"{run} is over; waiting for the next run ...", file=sys.stderr, flush=True)
                time.sleep(LAST_S)
        if viewer.alive():
            raise LookError("the process that draws ended by itself.")
        return 0
    finally:
        writer.close()


def _picture(live, viewer, writer, options):
    run = _first(live, options)
    if run is None:
        raise _none(live, options)
    _begin(live, run, writer)
    reached, stop = threading.Event(), threading.Event()

    def hear():
        _until_gone(live, writer, stop.is_set, lambda t_s: t_s >= (options.at or 0.0) and reached.set())
        reached.set()

    hearing = threading.Thread(target=hear, daemon=True)
    hearing.start()
    while not reached.wait(0.5):
        if not (viewer.alive() and writer.alive()):
            raise LookError("the viewer ended by itself.")
    try:
        png = picture.take(
            viewer.page,
            options.size,
            still=False,
            until_s=options.at or 0.0,
            alive=lambda: viewer.alive() and writer.alive(),
        )
        picture.write(options.picture, png)
    finally:
        stop.set()
        hearing.join(2.0)
    print(f"{options.picture}: written.")
    return 0


def _until_gone(live, writer, stopped, told=lambda t_s: None):
    """Passes on what is heard until the run is gone or it is `stopped`."""
    while not stopped():
        for e in live.hear(0.1):
            writer.put(e)
            if isinstance(e, Ended):
                return
            if not isinstance(e, SceneSaid):
                told(e.t_s)
