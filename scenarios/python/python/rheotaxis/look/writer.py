"""Draws a live run in a process of its own.

Logging to a viewer blocks for good once one of its readers stalls, and so does disconnecting. Here that stops only this
process: the mailbox before it goes on taking events, and its end is waited for a bounded time.
"""

import multiprocessing
import signal
import threading

from .errors import LookError
from .mailbox import Mailbox

#: Time between two batches, and longest time to wait for the end, s.
PERIOD_S, END_S = 0.05, 5.0


class Writer:
    """A process that draws what it is told: into the viewer at `target`, or into a file if that is a path."""

    def __init__(self, target, to_file, truth, view="all"):
        self.mailbox = Mailbox()
        context = multiprocessing.get_context("spawn")
        there, self._here = context.Pipe(duplex=False)
        self.process = context.Process(target=_main, args=(there, target, to_file, truth, view), daemon=True)
        self.process.start()
        there.close()
        self._sender = threading.Thread(target=self._send, daemon=True)
        self._sender.start()

    def put(self, event):
        """Adds an event; never waits."""
        self.mailbox.put(event)

    def alive(self):
        """Whether the process still draws."""
        return self.process.is_alive()

    def close(self):
        """Lets it draw what waits, for a bounded time; returns whether it came to an end by itself."""
        self.mailbox.close()
        self.process.join(END_S)
        ended = not self.process.is_alive()
        if not ended:
            self.process.kill()
            self.process.join(END_S)
        return ended and self.process.exitcode == 0

    def _send(self):
        # Only this thread waits for the process.
        try:
            while (batch := self.mailbox.take(0.5)) is not None:
                if batch:
                    self._here.send(batch)
                    threading.Event().wait(PERIOD_S)
        except (BrokenPipeError, OSError):
            pass
        self._here.close()


def _main(pipe, target, to_file, truth, view):
    # Ctrl-C reaches the whole group; the parent decides when this process ends.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    from .runs import Runs

    runs = Runs(target, to_file, truth, view)
    try:
        while True:
            runs.draw(pipe.recv())
    except EOFError:
        runs.end()
    except LookError as e:
        print(f"error: {e}", flush=True)
        raise SystemExit(1) from e
