"""The Rerun viewer as a process of its own, reachable from this machine only.

Both of Rerun's servers listen on all interfaces unless told otherwise, and do not say so when a port is taken. So they
are started through the viewer's own program with `--bind 127.0.0.1`, on ports that were tried before.
"""

import importlib.util
import os
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

from .errors import LookError

HOST = "127.0.0.1"
#: Ports of the page and of the data.
WEB_PORT, DATA_PORT = 9090, 9876
#: Longest time that a viewer may take to listen, and to end when it is told to, s.
START_S, END_S = 60.0, 3.0


def program():
    """The viewer's program, which comes with the Python package."""
    spec = importlib.util.find_spec("rerun_cli")
    name = "rerun.exe" if os.name == "nt" else "rerun"
    if spec and spec.origin and (inside := Path(spec.origin).parent / name).is_file():
        return str(inside)
    beside = Path(sys.executable).parent / name
    found = str(beside) if beside.is_file() else shutil.which("rerun")
    if not found:
        raise LookError('the viewer is not installed. Install it with: pip install "./scenarios/python[look]"')
    return found


def free(port):
    """Whether nothing listens on a port of this machine."""
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((HOST, port))
        except OSError:
            return False
    with socket.socket() as probe:
        probe.settimeout(0.3)
        return probe.connect_ex((HOST, port)) != 0


def port_for(wanted, usual, option, taken=()):
    """The port that a user asked for, or the usual one or the next free one."""
    if wanted is not None:
        if wanted in taken or not free(wanted):
            raise LookError(f"port {wanted} is taken: name another one with {option}, or leave the option out.")
        return wanted
    for port in range(usual, usual + 50):
        if port not in taken and free(port):
            return port
    raise LookError(f"the ports {usual} to {usual + 49} are all taken: name a free one with {option}.")


def has_display():
    """Whether a window can open here."""
    return sys.platform in ("darwin", "win32") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


class Viewer:
    """A viewer: a page and its data (`web`), or a window; `files` are shown, else it waits for data on `data_port`."""

    def __init__(self, web, memory, files=(), web_port=None, data_port=None):
        self.data_port = port_for(data_port, DATA_PORT, "--data-port")
        self.web_port = port_for(web_port, WEB_PORT, "--web-port", (self.data_port,)) if web else None
        command = [program(), *map(str, files), "--bind", HOST, "--port", str(self.data_port), "--hide-welcome-screen"]
        if web:
            command += ["--serve-web", "--web-viewer-port", str(self.web_port), "--server-memory-limit", memory]
        else:
            command += ["--memory-limit", memory, "--server-memory-limit", memory]
        # Its messages are dropped: a pipe that nobody reads would stop it once full.
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self._wait([self.data_port, *([self.web_port] if web else [])])

    @property
    def data(self):
        """Where data is sent to and read from."""
        return f"rerun+http://{HOST}:{self.data_port}/proxy"

    @property
    def page(self):
        """The page's address."""
        there = self.data.replace("+", "%2B")
        return f"http://{HOST}:{self.web_port}/?url={there}&renderer=webgl&hide_welcome_screen&theme=dark"

    def alive(self):
        """Whether it still runs."""
        return self.process.poll() is None

    def close(self):
        """Ends it, in bounded time."""
        if self.alive():
            self.process.terminate()
            try:
                self.process.wait(END_S)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait(END_S)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _wait(self, ports):
        deadline = time.monotonic() + START_S
        while not all(not free(p) for p in ports):
            if not self.alive():
                raise LookError(
                    f"the viewer ended at once (exit code {self.process.returncode})."
                    + ("" if self.web_port else " Is there a display? --web serves a page, --picture makes a picture.")
                )
            if time.monotonic() > deadline:
                self.close()
                raise LookError(f"the viewer did not start within {START_S:.0f} s.")
            time.sleep(0.1)
