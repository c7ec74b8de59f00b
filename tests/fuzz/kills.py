#!/usr/bin/env python3
"""Kills commands of `rheotaxis`, fills their disks, takes their outputs away, and looks at what is left.

    python3 tests/fuzz/kills.py --minutes 120

Each case takes one command that writes files and does one of these to it, one to four times:

    signal   SIGKILL, SIGTERM or SIGINT at a random moment
    disk     a file system with too little room (needs root, for it is mounted), also filled up in the middle
    size     a limit on the size of files (`ulimit -f`)
    stream   standard output or standard error that is full or closed

Then the command is run in the same folder without hindrance. A finding is: an exit code that is not documented, a
panic, an error without a word, a command that does not end; afterwards a command that no longer ends well, results
that differ from those of an undisturbed run, a temporary file that is left for good. The moment of a signal depends
on the machine, so a case cannot be made again exactly; its folder is kept in --out. The exit code is 1 if anything was
found.
"""

import argparse
import csv
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import inputs
import judge

ENDS = (0, 3)
SEEDS = 12
CAMPAIGN = inputs.SMALL.replace("seeds: 4", f"seeds: {SEEDS}")
LONG_S = 120.0


def digest(folder):
    return json.loads((folder / "out/summary.json").read_text())["digest"]


def rows(path):
    """A table without what depends on the machine's pace."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [{k: v for k, v in row.items() if "wall" not in k} for row in csv.DictReader(lines)]


def merged(binary, folder):
    subprocess.run([binary, "campaign", "merge", "out", "-o", "m.parquet", "--csv"], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return rows(folder / "m.csv")


def same_bytes(*names):
    return lambda _, folder: [(folder / name).read_bytes() for name in names]


# Arguments of each command, and what of its results must be as in an undisturbed run.
COMMANDS = {
    "run": (["run", "s.ron", "--quiet", "--no-zenoh", "--out", "out"], lambda _, folder: digest(folder)),
    "run live": (["run", "s.ron", "--quiet", "--out", "out"], lambda _, folder: digest(folder)),
    "campaign": (["campaign", "run", "c.ron", "--out", "out", "--block", "4", "--jobs", "2", "--quiet"], merged),
    "merge": (["campaign", "merge", "c", "-o", "all.parquet", "--csv"], lambda _, folder: rows(folder / "all.csv")),
    "report": (["campaign", "report", "c", "--out", "rep"], same_bytes("rep/arms.csv")),
    "reproduce": (["reproduce", "row.ron", "--seeds", "8", "--keep", "kept", "--out", "o", "--jobs", "2", "--quiet"],
                  lambda _, folder: rows(folder / "kept/duck_st.csv")),
    "trials": (["vehicle", "trials", "bluerov2", "--out", "t"], same_bytes("t/trials.csv")),
    "fly": (["vehicle", "fly", "bluerov2", "--table", "t.csv", "--out", "flown.csv"], same_bytes("flown.csv")),
    "statistics": (["statistics", "s.ron", "--quiet", "--seconds", "20", "--out", "st"],
                   same_bytes("st/statistics.csv")),
    "picture": (["picture", "s.ron", "--at", "0,0,-1", "--out", "p.png", "--truth", "q.png"],
                same_bytes("p.png", "q.png")),
    "segment": (["segment", "a.png", "--out", "sg"], same_bytes("sg/segmentation.json")),
    "score-vision": (["score-vision", "--quiet", "--jobs", "2", "--scenes", "2", "--width", "64", "--out", "sv"],
                     lambda _, folder: sorted(p.name for p in (folder / "sv").iterdir())),
}


class Kills:
    """The cases, how their commands ended, and what was found."""

    def __init__(self, args, scratch):
        self.args, self.scratch = args, scratch
        self.binary = str(args.binary.resolve())
        self.whole = scratch / "clean"
        base = inputs.Base(self.binary, scratch)
        self.whole.mkdir()
        text = base.scenarios["uniform_channel"]
        (self.whole / "s.ron").write_text(re.sub(r"\blimit_s:\s*[^,()\s]+", "limit_s: 200", text))
        (self.whole / "c.ron").write_text(CAMPAIGN)
        row = re.sub(r'scenario: "[^"]*"', 'scenario: "s.ron"', base.rows["duck_st"])
        (self.whole / "row.ron").write_text(row)
        drives = [f"thruster_{at}_{side}" for at in ("front", "aft", "up") for side in ("right", "left")]
        (self.whole / "t.csv").write_text(f"t_s,{','.join(drives)}\n0{',0.5' * len(drives)}\n")
        (self.whole / "a.png").write_bytes(base.pictures["png"])
        shutil.copytree(base.campaign / "out", self.whole / "c")
        self.ends, self.cases, self.found = Counter(), Counter(), Counter()
        self.expected, self.takes_s = {}, {}
        for name, (arguments, results) in COMMANDS.items():
            folder = self.fresh(scratch / f"expected-{name.replace(' ', '-')}")
            begun = time.monotonic()
            done = subprocess.run([self.binary, *arguments], cwd=folder, env=self.env(), capture_output=True)
            self.takes_s[name] = time.monotonic() - begun
            if done.returncode not in ENDS:
                sys.exit(f"{name} does not even run: {done.stderr.decode(errors='replace')}")
            self.expected[name] = results(self.binary, folder)

    def env(self):
        taken = ("ZENOH", "RHEOTAXIS")
        env = {k: v for k, v in os.environ.items() if not k.startswith(taken)}
        return env | {"NO_COLOR": "1", "RHEOTAXIS_NO_CACHE": "1", "TMPDIR": str(self.scratch)}

    def fresh(self, folder):
        shutil.copytree(self.whole, folder, dirs_exist_ok=True)
        return folder

    def case(self, n):
        rng = random.Random(f"{self.args.seed}/{n}")
        name = rng.choice(list(COMMANDS))
        kinds = ["signal"] * 5 + ["size", "stream"] + ["disk"] * 3 * (os.geteuid() == 0)
        kind = rng.choice(kinds)
        folder = self.scratch / f"case-{n}"
        faults = []
        folder.mkdir()
        mounted = kind == "disk"
        if mounted:
            # Of the size of what is in it and up to 300 kB; a run writes some hundred kB.
            room = 400 + rng.randrange(0, 300) * rng.choice([1, 4])
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={room}k", "tmpfs", folder], check=True)
        try:
            self.fresh(folder)
            for _ in range(rng.randint(1, 4)):
                faults += getattr(self, kind)(rng, name, folder)
            if mounted:
                (folder / "filler").unlink(missing_ok=True)
                subprocess.run(["mount", "-o", "remount,size=200m", folder], check=True)
            faults += self.unhindered(name, folder)
            if faults:
                kept = self.args.out / f"{self.args.seed}-{n}"
                shutil.copytree(folder, kept, dirs_exist_ok=True, symlinks=True)
                text = "\n".join(f"{name}, {kind}: {fault}" for fault in faults)
                (kept / "finding.txt").write_text(text + "\n", encoding="utf-8")
                for fault in faults:
                    sort = f"{name}, {kind}: {judge.signature(fault)[:200]}"
                    self.found[sort] += 1
                    if self.found[sort] == 1:
                        print(f"FOUND {kept}: {name}, {kind}: {fault[:400]}", flush=True)
        except OSError as error:
            # The inputs themselves did not fit.
            if not mounted:
                raise
            self.ends[name, kind, f"no room for the inputs ({error.strerror})"] += 1
        finally:
            if mounted:
                subprocess.run(["umount", folder], check=True)
            shutil.rmtree(folder)
        self.cases[name, kind] += 1

    def start(self, name, folder, prepare=None, **streams):
        arguments = [self.binary, *COMMANDS[name][0]]
        streams = {"stdout": subprocess.DEVNULL, "stderr": self.scratch / "said"} | streams
        files = [open(v, "wb") if isinstance(v, Path) else v for v in streams.values()]
        process = subprocess.Popen(arguments, cwd=folder, env=self.env(), stdin=subprocess.DEVNULL, preexec_fn=prepare,
                                   **dict(zip(streams, files)))
        for file in files:
            if hasattr(file, "close"):
                file.close()
        return process

    def ended(self, name, kind, process, allowed, seconds=LONG_S):
        """How it ended, and what is wrong with that."""
        if not judge.wait(process, seconds):
            process.kill()
            process.wait()
            return [f"does not end within {seconds:g} s"]
        code = process.returncode
        self.ends[name, kind, code] += 1
        said = (self.scratch / "said").read_text(errors="replace")
        faults = []
        if "panicked at" in said:
            faults.append("panic: " + said[said.index("panicked at"):][:300])
        if code not in allowed:
            faults.append(f"exit code {code}: {said.strip()[-300:]}")
        if code == 1 and kind in ("disk", "size") and not said.strip():
            faults.append("exit code 1 without a word")
        return faults

    def signal(self, rng, name, folder):
        which = rng.choice([signal.SIGKILL] * 3 + [signal.SIGTERM, signal.SIGINT])
        process = self.start(name, folder)
        # Half of the signals come near the end, where files are put in their places.
        share = rng.uniform(0.0, 1.1) if rng.random() < 0.5 else rng.uniform(0.8, 1.1)
        after_s = share * self.takes_s[name]
        if not judge.wait(process, after_s):
            process.send_signal(which)
        # Before it has begun, nobody can answer for it.
        early = [-which] if after_s < 0.1 else []
        own = [-which] if which == signal.SIGKILL else [130, 75, *early]
        return self.ended(name, "signal", process, (*ENDS, *own))

    def disk(self, rng, name, folder):
        process = self.start(name, folder)
        if rng.random() < 0.5:
            judge.wait(process, rng.uniform(0.0, 1.0) * self.takes_s[name])
            try:
                with open(folder / "filler", "wb") as file:
                    while True:
                        file.write(bytes(4096))
                        file.flush()
            except OSError:
                pass
        return self.ended(name, "disk", process, (0, 1, 3))

    def size(self, rng, name, folder):
        most = int(10 ** rng.uniform(1.0, 6.0))
        prepare = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        # What it says goes into a pipe, for a file would be cut as well.
        process = self.start(name, folder, prepare, stderr=subprocess.PIPE)
        said = process.stderr.read()
        (self.scratch / "said").write_bytes(said)
        return self.ended(name, "size", process, (0, 1, 3))

    def stream(self, rng, name, folder):
        (self.scratch / "said").write_text("")
        which = rng.choice(["stdout", "stderr"])
        if rng.random() < 0.5:
            process = self.start(name, folder, **{which: Path("/dev/full")})
        else:
            read, write = os.pipe()
            os.close(read)
            process = self.start(name, folder, **{which: write})
            os.close(write)
        return self.ended(name, f"stream", process, (0, 1, 3, -signal.SIGPIPE, 141))

    def unhindered(self, name, folder):
        """The same command without hindrance: it ends well and gives what it should."""
        faults = self.ended(name, "after", self.start(name, folder), ENDS)
        if faults:
            return [f"afterwards: {fault}" for fault in faults]
        try:
            if COMMANDS[name][1](self.binary, folder) != self.expected[name]:
                faults.append("afterwards: other results than those of an undisturbed run")
        except (OSError, ValueError, KeyError, subprocess.CalledProcessError) as error:
            faults.append(f"afterwards: results cannot be read: {error}")
        left = [p for p in folder.rglob("*") if p.is_file() and ".tmp" in p.name]
        if left:
            faults.append("temporary files left: " + ", ".join(re.sub(r"\d+", "N", p.name) for p in left))
        return faults

    def table(self):
        print(f"\nseed {self.args.seed}: cases, and how the commands in them ended (a signal as -N)")
        for name, kind in sorted(self.cases):
            ends = sorted((str(code), k) for (a, b, code), k in self.ends.items() if (a, b) == (name, kind))
            print(f"  {name:14} {kind:8} {self.cases[name, kind]:6}  {', '.join(f'{c}: {k}' for c, k in ends)}")
        killed = sum(k for (_, kind, code), k in self.ends.items() if kind == "signal" and code not in ENDS)
        print(f"  {sum(self.cases.values())} cases, {sum(self.ends.values())} commands, {killed} ended by signals")
        for sort, times in sorted(self.found.items()):
            print(f"FOUND {times} times: {sort}")
        if not self.found:
            print("nothing found")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    release = inputs.ROOT / "target" / "release" / "rheotaxis"
    parser.add_argument("--minutes", type=float, default=10.0, help="how long (10)")
    parser.add_argument("--seed", type=int, default=1, help="of the choices (1)")
    parser.add_argument("--binary", type=Path, default=release, help="the program (target/release/rheotaxis)")
    parser.add_argument("--out", type=Path, default=Path("kill-findings"), help="where findings go (kill-findings)")
    args = parser.parse_args()
    if not args.binary.is_file():
        sys.exit(f"{args.binary}: there is no such program; cargo build --release makes it")
    begun, n = time.monotonic(), 0
    with tempfile.TemporaryDirectory(prefix="kills-", ignore_cleanup_errors=True) as scratch:
        kills = Kills(args, Path(scratch))
        while time.monotonic() < begun + 60 * args.minutes:
            n += 1
            kills.case(n)
            if n % 50 == 0:
                minutes = (time.monotonic() - begun) / 60
                print(f"{minutes:6.1f} min: {n} cases, {len(kills.found)} sorts of findings", flush=True)
        kills.table()
        return 1 if kills.found else 0


if __name__ == "__main__":
    sys.exit(main())
