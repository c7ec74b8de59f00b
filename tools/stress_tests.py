#!/usr/bin/env python3
"""Runs the tests that depend on other processes, zenoh, signals or clocks again and again on a busy machine.

Builds nothing: the test binaries are those that cargo has built, and are asked for with

    cargo test --release --workspace --no-run --message-format=json

which takes a moment if all is built (`--profile dev` asks without --release, `--binaries FILE` reads that command's
output from a file instead). Beside them run busy processes, which do nothing but compute (`--busy`). Each round runs
each binary once, with the filters below. A table of passes, failures and times is printed at the end; the output of a
binary in which a test failed is kept in `--keep`. Ends with 0 if all tests passed, and with 1 otherwise. The busy
processes end with this program, however it ends.

Which tests are chosen: in the binary `it`, the modules in IT, whose tests talk with a process while it runs, over
zenoh, by signals or by what it writes; of the other crates, the modules in UNITS, whose tests have threads, clocks or
locks on files. `--filter` chooses others, `--all` runs all tests of all these binaries.

    tools/stress_tests.py                                   # 20 rounds beside 6 busy processes
    tools/stress_tests.py --rounds 3 --filter outside::     # one module, three times
    tools/stress_tests.py --busy 0 --rounds 1 --single      # each test alone, with its wall and processor time
"""

import argparse
import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
IT = [
    "outside::", "live::", "interrupt::", "campaign::", "lanes::", "cache::", "outputs::", "memory::", "determinism::",
    "abnormal::", "bad_input::busy",
]
UNITS = {
    "output": ["live::", "follow::"],
    "studies": ["campaign::"],
    "rheotaxis": ["cache::", "lanes::"],
    "world": ["files::"],
}
# Computes until its parent is gone, even if that was killed.
BUSY = "import os, sys\np = int(sys.argv[1])\nwhile os.getppid() == p:\n    for _ in range(1000000): pass"
RESULT = re.compile(r"^test (\S+)(?: - should panic)? \.\.\. (ok|FAILED|ignored)", re.MULTILINE)
TAIL = re.compile(r"^\s*(ok|FAILED)$", re.MULTILINE)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=20, help="how often each binary runs [20]")
    parser.add_argument("--busy", type=int, default=6, help="busy processes beside the tests [6]")
    parser.add_argument("--profile", choices=["release", "dev"], default="release", help="whose binaries [release]")
    parser.add_argument("--binaries", type=Path, help="what cargo said with --message-format=json")
    parser.add_argument("--filter", nargs="+", help="names of tests, or parts of them, instead of those chosen")
    parser.add_argument("--all", action="store_true", help="all tests of these binaries")
    parser.add_argument("--single", action="store_true", help="each test in a process of its own, to measure it")
    parser.add_argument("--limit", type=float, default=1800.0, help="a binary that takes longer has failed, s [1800]")
    parser.add_argument("--keep", type=Path, default=ROOT / "target/stress", help="folder for the output of failures")
    return parser.parse_args()


def binaries(args):
    """Name, path and folder of each test binary that is chosen."""
    if args.binaries:
        said = args.binaries.read_text()
    else:
        command = ["cargo", "test", "--workspace", "--no-run", "--message-format=json"]
        command += ["--release"] if args.profile == "release" else []
        said = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
    found = {}
    for line in said.splitlines():
        if not line.startswith("{"):
            continue
        message = json.loads(line)
        if message.get("reason") != "compiler-artifact" or not message.get("executable"):
            continue
        name, kind = message["target"]["name"], message["target"]["kind"]
        if message["profile"]["test"] and (name == "it" or (name in UNITS and "lib" in kind)):
            found[name] = (Path(message["executable"]), Path(message["manifest_path"]).parent)
    missing = [name for name in ["it", *UNITS] if name not in found]
    if missing:
        sys.exit(f"cargo told no test binary of {', '.join(missing)}; it told of {', '.join(found) or 'none'}")
    return found


def names(binary, folder, filters):
    """The tests that filters choose, without those that are ignored."""
    def listed(*more):
        said = subprocess.run([binary, "--list", *more, *filters], cwd=folder, stdout=subprocess.PIPE, text=True)
        return [line[: -len(": test")] for line in said.stdout.splitlines() if line.endswith(": test")]

    ignored = set(listed("--ignored"))
    return [name for name in listed() if name not in ignored]


def run(command, folder, limit_s):
    """What a test binary says, its exit code (None if it was stopped), wall time and processor time, s."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    # A session of its own, so that whatever it started can be ended with it.
    child = subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )
    try:
        said, _ = child.communicate(timeout=limit_s)
        code = child.returncode
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        said, code = child.communicate()[0], None
    except BaseException:
        os.killpg(child.pid, signal.SIGKILL)
        raise
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return said, code, time.monotonic() - began, used


class Counts:
    def __init__(self):
        self.passed, self.failed, self.walls, self.used = 0, 0, [], []

    def row(self, name):
        walls, used = self.walls, self.used
        if not walls:
            return f"{self.passed:6} {self.failed:6} {'':26}  {name}"
        mean = sum(walls) / len(walls)
        return f"{self.passed:6} {self.failed:6} {mean:8.1f} {max(walls):8.1f} {sum(used) / len(used):8.1f}  {name}"


def judge(name, result, tests, counts, args, round_):
    """Counts what a binary said of each of its tests; the name of the file that keeps it, if any failed."""
    said, code, wall_s, used_s = result
    told = dict(RESULT.findall(said))
    failed = [test for test in tests if told.get(test) != "ok"]
    if code == 0 and TAIL.search(said):
        # A test that writes to standard output itself has its result on a line of its own.
        failed = []
    for test in tests:
        count = counts.setdefault(f"{name} {test}", Counts())
        count.failed += test in failed
        count.passed += test not in failed
    whole = counts.setdefault(f"{name} (all of it)" if len(tests) != 1 else f"{name} {tests[0]}", Counts())
    whole.walls.append(wall_s)
    whole.used.append(used_s)
    if len(tests) != 1:
        whole.failed += code != 0
        whole.passed += code == 0
    if code == 0 and not failed:
        return None
    if len(tests) == 1 and not failed:
        counts[f"{name} {tests[0]}"].failed += 1
    args.keep.mkdir(parents=True, exist_ok=True)
    file = args.keep / f"round{round_}-{name}-{len(list(args.keep.iterdir()))}.txt"
    file.write_text(said + ("" if code is not None else f"\nstopped after {args.limit} s\n"))
    return file


def main():
    args = arguments()
    # So that the busy processes end when this program is asked to end.
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: sys.exit(1))
    work = []
    for name, (binary, folder) in binaries(args).items():
        filters = [] if args.all else args.filter or (IT if name == "it" else UNITS[name])
        tests = names(binary, folder, filters)
        if args.single:
            work += [(name, [binary, "--exact", test], folder, [test]) for test in tests]
        elif tests:
            work.append((name, [binary, *filters], folder, tests))
    if not work:
        sys.exit("no test has such a name")
    print(f"{sum(len(tests) for *_, tests in work)} tests, {args.rounds} rounds, {args.busy} busy processes", flush=True)
    counts, busy = {}, []
    try:
        for _ in range(args.busy):
            busy.append(subprocess.Popen([sys.executable, "-c", BUSY, str(os.getpid())]))
        for round_ in range(1, args.rounds + 1):
            began = time.monotonic()
            kept = [judge(n, run(c, f, args.limit), t, counts, args, round_) for n, c, f, t in work]
            kept = [str(file) for file in kept if file]
            print(f"round {round_}: {time.monotonic() - began:.0f} s, {', '.join(kept) or 'all passed'}", flush=True)
    finally:
        for process in busy:
            process.kill()
        for process in busy:
            process.wait()
        print("passed failed  wall_s  longest    cpu_s  test")
        for name, count in sorted(counts.items(), key=lambda item: (-item[1].failed, -sum(item[1].used), item[0])):
            print(count.row(name))
    sys.exit(any(count.failed for count in counts.values()))


if __name__ == "__main__":
    main()
