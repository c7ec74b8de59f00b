#!/usr/bin/env python3
"""Feeds damaged inputs to every reader of `rheotaxis` and reports what should not have happened.

    python3 tests/fuzz/fuzz.py --minutes 60 --jobs 2

`check` reads most of them; what it calls fine is run for a few simulated seconds under a limit of memory and time. A
finding is a panic, an exit code that is not documented (0, 1, 2, 3, 130; 75 for campaigns), a signal, a command that
takes longer or holds more than it may, an error that names no file, a run that `check` calls fine and that fails or
does not end at Ctrl-C, a `.tmp` file left behind, a pipe or device that is replaced. Python 3 alone is needed.

Each finding goes to OUT/<number>/: the input as files, `finding.txt` with what happened and the command, `repeat.sh`.
A case hangs on nothing but --seed and its number: `--only NUMBER` makes it again. `--kinds text,block` takes only
these. The exit code is 1 if anything was found. The kinds of input stand in `inputs.py`, the damage in `mutate.py`,
limits and judgement in `judge.py`.
"""

import argparse
import os
import random
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import inputs
import judge

KEPT = 3


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    release = inputs.ROOT / "target" / "release" / "rheotaxis"
    parser.add_argument("--minutes", type=float, default=5.0, help="how long (5)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="cases at a time (one a core)")
    parser.add_argument("--seed", type=int, default=1, help="of all damage (1)")
    parser.add_argument("--binary", type=Path, default=release, help="the program (target/release/rheotaxis)")
    parser.add_argument("--memory", type=int, default=6144, metavar="MB", help="address space of a command (6144)")
    parser.add_argument("--check-seconds", type=float, default=10.0, help="processor time of a reader (10)")
    parser.add_argument("--run-seconds", type=float, default=20.0, help="processor time of a run before Ctrl-C (20)")
    parser.add_argument("--out", type=Path, default=Path("fuzz-findings"), help="where findings go (fuzz-findings)")
    parser.add_argument("--kinds", help="only these, by commas")
    parser.add_argument("--only", type=int, metavar="NUMBER", help="make one case again")
    return parser.parse_args()


class Fuzz:
    """The cases, what they came to, and what was found."""

    def __init__(self, args, scratch):
        self.args = args
        self.scratch = scratch
        self.binary = str(args.binary.resolve())
        self.limits = judge.Limits(args.memory << 20, args.check_seconds, args.run_seconds)
        # The program's own limit on what a scenario may need leaves room for the program itself.
        said = subprocess.run([self.binary, "--help"], capture_output=True, text=True, check=True).stdout
        self.always = ["--memory", f"{args.memory * 65 // 100}M"] if "--memory" in said else []
        (scratch / "tmp").mkdir()
        self.base = inputs.Base(self.binary, scratch)
        self.kinds = inputs.KINDS
        if args.kinds:
            wanted = args.kinds.split(",")
            self.kinds = [k for k in inputs.KINDS if k[0].__name__ in wanted]
        self.lock = threading.Lock()
        self.cases, self.ends, self.found, self.runs = Counter(), Counter(), {}, 0
        self.begun = time.monotonic()

    def case(self, n):
        """One input: made, read, judged."""
        rng = random.Random(f"{self.args.seed}/{n}")
        kind = rng.choices([k for k, _ in self.kinds], [w for _, w in self.kinds])[0]
        at = self.scratch / f"case-{n}"
        at.mkdir()
        done = []

        def do(command, said_s=None):
            end = judge.run([self.binary, *self.always], command, str(at), self.limits, said_s)
            done.append((command, end))
            return end

        kind(rng, self.base, at, do)
        with self.lock:
            self.cases[kind.__name__] += 1
            for command, end in done:
                self.runs += command.run
                self.ends[kind.__name__, end.code] += 1
            for command, end in done:
                for fault in end.faults:
                    self.keep(n, kind.__name__, at, command, end, fault)
        if self.args.only is None:
            shutil.rmtree(at, onerror=lambda remove, path, _: (os.chmod(path, 0o700), remove(path)))

    def keep(self, n, kind, at, command, end, fault):
        """Writes a finding, a few of each sort."""
        sort = f"{kind}: {command.args[0]}: {judge.signature(fault)}"
        numbers = self.found.setdefault(sort, [])
        numbers.append(n)
        if len(numbers) > KEPT:
            return
        to = self.args.out / f"{self.args.seed}-{n}"
        to.mkdir(parents=True, exist_ok=True)
        small = [p for p in at.iterdir() if p.is_file() and not p.is_symlink() and p.stat().st_size < 1 << 22]
        for path in small:
            if os.access(path, os.R_OK):
                shutil.copy(path, to / path.name)
        if kind in ("mesh", "urdf", "scenario") and (at / "meshes").is_dir():
            shutil.copytree(at / "meshes", to / "meshes", dirs_exist_ok=True)
        folders = {"block": "out", "manifest": "out", "kept": "kept", "vehicle": "v"}
        if kind in folders and (at / folders[kind]).is_dir():
            shutil.copytree(at / folders[kind], to / folders[kind], dirs_exist_ok=True)
        words = " ".join(command.args)
        with open(to / "finding.txt", "a", encoding="utf-8") as file:
            file.write(f"{fault}\n  rheotaxis {words}\n  exit code {end.code}; limits: {self.limits}\n"
                       f"  again: python3 tests/fuzz/fuzz.py --seed {self.args.seed} --only {n}"
                       f"{' --kinds ' + self.args.kinds if self.args.kinds else ''}\n{end.said[-4000:]}\n\n")
        (to / "repeat.sh").write_text(f"ulimit -v {self.args.memory << 10}\n{' '.join([self.binary, *self.always])} {words}\n", encoding="utf-8")
        if len(numbers) == 1:
            print(f"FOUND {to}: {kind}: {words[:80]}: {fault[:300]}", flush=True)

    def worker(self, numbers):
        while time.monotonic() < self.begun + 60 * self.args.minutes:
            with self.lock:
                n = next(numbers)
            try:
                self.case(n)
            except Exception as error:
                raise RuntimeError(f"case {n} of seed {self.args.seed}: the script itself failed") from error

    def progress(self):
        with self.lock:
            minutes = (time.monotonic() - self.begun) / 60
            print(f"{minutes:6.1f} min: {sum(self.cases.values())} inputs, {sum(self.ends.values())} commands, "
                  f"{self.runs} of them runs, {len(self.found)} sorts of findings", flush=True)

    def table(self):
        print(f"\nseed {self.args.seed}; {'inputs':>20} {'commands':>9}  exit codes")
        for kind, n in sorted(self.cases.items()):
            codes = sorted((c, k) for (name, c), k in self.ends.items() if name == kind)
            said = ", ".join(f"{c}: {k}" for c, k in codes)
            print(f"  {kind:20} {n:>10} {sum(k for _, k in codes):>9}  {said}")
        print(f"  {'all':20} {sum(self.cases.values()):>10} {sum(self.ends.values()):>9}  {self.runs} runs")
        for sort, numbers in sorted(self.found.items()):
            shown = ", ".join(map(str, numbers[:KEPT]))
            print(f"FOUND {len(numbers)} times (cases {shown}): {sort}")
        if not self.found:
            print("nothing found")


def main():
    args = arguments()
    if not args.binary.is_file():
        sys.exit(f"{args.binary}: there is no such program; cargo build --release makes it")
    # A folder that a process on its way down still writes to is left to the system.
    with tempfile.TemporaryDirectory(prefix="fuzz-", ignore_cleanup_errors=True) as scratch:
        fuzz = Fuzz(args, Path(scratch))
        if args.only is not None:
            fuzz.case(args.only)
        else:
            numbers = iter(range(1, 1 << 62))
            with ThreadPoolExecutor(args.jobs) as pool:
                workers = [pool.submit(fuzz.worker, numbers) for _ in range(args.jobs)]
                while not all(w.done() for w in workers):
                    time.sleep(1)
                    if int(time.monotonic() - fuzz.begun) % 20 == 0:
                        fuzz.progress()
            for worker in workers:
                worker.result()
        fuzz.table()
        return 1 if fuzz.found else 0


if __name__ == "__main__":
    sys.exit(main())
