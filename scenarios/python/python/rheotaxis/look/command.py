"""The command: options, errors, exit codes."""

import sys

#: What the look needs beside the package itself: module and package.
NEEDED = {"rerun": "rerun-sdk", "mcap": "mcap", "zenoh": "eclipse-zenoh", "PIL": "pillow", "zstandard": "zstandard"}


def main(words=None):
    """Runs the command; returns its exit code."""
    from importlib.util import find_spec

    from . import arguments
    from .errors import LookError

    options = arguments.read(words)
    missing = [package for module, package in NEEDED.items() if find_spec(module) is None]
    if missing:
        print(
            f'error: {", ".join(missing)} is missing. Install it with: pip install "./scenarios/python[look]"',
            file=sys.stderr,
        )
        return 1
    from . import follow, replay

    try:
        return (replay if options.recording else follow).show(options)
    except LookError as e:
        print(f"error: {e}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 0
