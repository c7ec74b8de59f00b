"""Headless Chromium: opens a page and takes pictures of it.

It is spoken to over two pipes in the DevTools protocol (`--remote-debugging-pipe`): messages of JSON, each ended by a
zero byte. No port is opened.
"""

import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

from .errors import EndedError, LookError

#: Where to look for it; the environment variable CHROMIUM goes before.
NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
#: Software rendering, no sandbox for containers, and no calls home.
FLAGS = (
    "--headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --disable-quic --no-first-run "
    "--disable-background-networking --disable-component-update --disable-sync --hide-scrollbars --mute-audio"
).split()


def find():
    """Chromium's program, or None."""
    named = os.environ.get("CHROMIUM")
    return shutil.which(named) if named else next(filter(None, map(shutil.which, NAMES)), None)


class Chromium:
    """A browser with one page."""

    def __init__(self, width, height):
        program = find()
        if not program:
            raise LookError(
                "no Chromium found, which --picture needs. "
                "Install chromium, or name it in the environment variable CHROMIUM."
            )
        self.folder = tempfile.TemporaryDirectory(prefix="rheotaxis-look-", ignore_cleanup_errors=True)
        to_read, to_write = os.pipe()
        back_read, back_write = os.pipe()
        # Kept away from 3 and 4, which are the browser's ends.
        there, back = (fcntl.fcntl(fd, fcntl.F_DUPFD, 10) for fd in (to_read, back_write))

        def ends():
            os.dup2(there, 3)
            os.dup2(back, 4)

        self.process = subprocess.Popen(
            [
                program,
                *FLAGS,
                "--remote-debugging-pipe",
                f"--user-data-dir={self.folder.name}",
                f"--window-size={width},{height}",
                "about:blank",
            ],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            pass_fds=(3, 4),
            preexec_fn=ends,
            start_new_session=True,
        )
        for fd in (to_read, back_write, there, back):
            os.close(fd)
        self.out, self.into, self.rest, self.number, self.session = to_write, back_read, b"", 0, None
        os.set_blocking(self.out, False)
        pages = self.call("Target.getTargets")["targetInfos"]
        page = next(p for p in pages if p["type"] == "page")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def call(self, method, patience_s=60.0, **parameters):
        """Calls a method of the protocol and returns its result."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        deadline = time.monotonic() + patience_s
        self._write(json.dumps(message).encode() + b"\0", deadline, method)
        while True:
            said = self._message(deadline, method)
            if said.get("id") == self.number:
                if "error" in said:
                    raise LookError(f"Chromium refused {method}: {said['error'].get('message')}.")
                return said["result"]

    def _write(self, data, deadline, method):
        while data:
            if not select.select([], [self.out], [], max(0.0, deadline - time.monotonic()))[1]:
                raise LookError(f"Chromium did not take {method} in time.")
            try:
                data = data[os.write(self.out, data) :]
            except BrokenPipeError as e:
                raise EndedError("Chromium ended by itself. Is the machine short of memory?") from e

    def _message(self, deadline, method):
        while b"\0" not in self.rest:
            if not select.select([self.into], [], [], max(0.0, deadline - time.monotonic()))[0]:
                raise LookError(f"Chromium did not answer {method} in time.")
            more = os.read(self.into, 1 << 20)
            if not more:
                raise EndedError("Chromium ended by itself. Is the machine short of memory?")
            self.rest += more
        said, _, self.rest = self.rest.partition(b"\0")
        return json.loads(said)

    def open(self, address):
        """Opens a page."""
        self.call("Page.navigate", url=address)

    def picture(self):
        """What the page shows now, PNG."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])

    def value(self, expression):
        """The value of an expression of JavaScript in the page, or None if it has none."""
        said = self.call("Runtime.evaluate", expression=expression, returnByValue=True)
        return said.get("result", {}).get("value")

    def click(self, x, y):
        """A click of the left button, pixels from the left and the top."""
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def close(self):
        """Ends the browser, in bounded time."""
        for fd in (self.out, self.into):
            os.close(fd)
        if self.process.poll() is None:
            try:
                os.killpg(self.process.pid, 15)
                self.process.wait(5)
            except (subprocess.TimeoutExpired, ProcessLookupError):
                os.killpg(self.process.pid, 9)
                self.process.wait(5)
        self.folder.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
