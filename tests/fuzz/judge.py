"""Runs one command under limits of memory, processor time and patience, and judges how it ended."""

import os
import re
import resource
import signal
import subprocess
import time
from dataclasses import dataclass, field

ENDS = (0, 1, 2, 3, 130)
MOST_SAID = 1 << 20


@dataclass
class Limits:
    """What a command may take."""

    memory: int
    check_s: float
    run_s: float


@dataclass
class Command:
    """Arguments, what a message must name one of, what is allowed, and how long to wait for one that sleeps."""

    args: list
    names: tuple = ()
    run: bool = False
    ends: tuple = ENDS
    patience_s: float = 0.0


@dataclass
class End:
    """How a command ended."""

    code: int
    said: str
    out: str
    faults: list = field(default_factory=list)
    killed: bool = False


def limited(limits, seconds):
    def set_limits():
        os.setsid()
        resource.setrlimit(resource.RLIMIT_AS, (limits.memory, limits.memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 31, 1 << 31))

    return set_limits


def tail(path):
    with open(path, "rb") as file:
        file.seek(0, 2)
        size = file.tell()
        file.seek(max(0, size - MOST_SAID))
        return file.read().decode("utf-8", "replace"), size


UNITS = (("ms", 1e-3), ("s", 1.0), ("min", 60.0), ("h", 3600.0), ("d", 86400.0), ("week", 6e5), ("month", 3e6), ("y", 3e7))


def estimate_s(text):
    """What `check` says a run will take, s; none if it says nothing."""
    found = re.search(r"about ([\d.]+(?:e[+-]?\d+)?) ?([a-z]+)", text)
    unit = found and [s for name, s in UNITS if found.group(2).startswith(name)]
    return float(found.group(1)) * unit[-1] if unit else None


def wait(process, seconds):
    try:
        process.wait(max(0.0, seconds))
        return True
    except subprocess.TimeoutExpired:
        return False


def used_s(process):
    """Processor time of a running process, s."""
    try:
        with open(f"/proc/{process.pid}/stat", encoding="ascii", errors="replace") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return 0.0


def run(program, command, folder, limits, said_s=None):
    """Runs a command in a folder to its end. A run that is expected to be long is stopped as a person would."""
    seconds = limits.run_s if command.run else limits.check_s
    patience = command.patience_s or 3 * seconds + 20
    paths = [os.path.join(folder, name) for name in (".out", ".err")]
    env = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM", "HQ_", "ZENOH", "RHEOTAXIS", "JOB_"))}
    env |= {"NO_COLOR": "1", "RHEOTAXIS_NO_CACHE": "1", "MALLOC_ARENA_MAX": "2",
            "TMPDIR": os.path.join(folder, "..", "tmp")}
    begun = time.monotonic()
    faults = []
    with open(paths[0], "wb") as out, open(paths[1], "wb") as err:
        process = subprocess.Popen(
            [*program, *command.args], cwd=folder, env=env, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
            preexec_fn=limited(limits, int(3 * seconds + 60)),
        )
        stopped = False
        while not wait(process, 0.02 if time.monotonic() - begun < 1 else 0.25):
            waited = time.monotonic() - begun
            if used_s(process) < seconds and waited < patience:
                continue
            if command.run and not stopped:
                # As a person would: Ctrl-C, and a second one for who does not want to wait.
                stopped = True
                process.send_signal(signal.SIGINT)
                if wait(process, 20):
                    break
                process.send_signal(signal.SIGINT)
                if wait(process, 10):
                    break
                faults.append("does not end at a second Ctrl-C")
            else:
                faults.append(f"takes longer than {seconds:g} s")
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            break
    said, size = tail(paths[1])
    printed, size_out = tail(paths[0])
    for path in paths:
        os.remove(path)
    end = End(process.returncode, said, printed, faults, stopped or bool(faults))
    if stopped and not faults and (said_s is None or said_s < seconds / 10):
        told = "nothing" if said_s is None else f"{said_s:g} s"
        faults.append(f"still runs after {seconds:g} s, `check` said {told}")
    if max(size, size_out) > MOST_SAID:
        faults.append("says more than a megabyte")
    judge(end, command, folder)
    return end


def judge(end, command, folder):
    """Adds to an end what must not be."""
    faults, text = end.faults, end.said
    panic = re.search(r"panicked at ([^\n]*)\n?([^\n]*)", text)
    if panic:
        faults.append(f"panic at {panic.group(1).rstrip(':')}: {panic.group(2)}")
    if "memory allocation of" in text or "out of memory" in text.lower():
        faults.append("memory limit: " + re.search(r"[^\n]*(?i:memory allocation of|out of memory)[^\n]*", text).group(0))
    # A command without a handler of its own ends at Ctrl-C by the signal.
    if end.code < 0 and not (end.killed and (faults or end.code == -signal.SIGINT)):
        faults.append(f"killed by {signal.Signals(-end.code).name}")
    elif end.code >= 0 and end.code not in command.ends:
        faults.append(f"exit code {end.code}")
    if end.code == 1 and not text.strip():
        faults.append("exit code 1 without a word")
    # In a text the place is shown, with the file's name; otherwise the message must name one.
    named = "\u256d\u2500[" in text or any(name in text for name in command.names)
    if end.code == 1 and not panic and command.names and not named:
        faults.append("an error that names no file: " + first_line(text))
    if end.code >= 0:
        left = [os.path.join(at, f) for at, _, files in os.walk(folder) for f in files if f.endswith(".tmp")]
        # What was recorded before a panic is kept, by intent.
        left = [f for f in left if not (panic and "run.mcap." in f)]
        if left:
            faults.append("leaves " + ", ".join(re.sub(r"\d+", "N", os.path.relpath(f, folder)) for f in left))


def first_line(text):
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[0][:200] if lines else ""


def signature(fault):
    """The same for two faults that are likely the same."""
    if fault.startswith("an error that names no file"):
        return "an error that names no file"
    fault = re.sub(r"\"[^\"]*\"|`[^`]*`", "X", fault)
    return re.sub(r"[-+]?\d[\d.e+-]*(?<![:.])", "N", fault) if "panic at" not in fault else fault.split(": ")[0]
