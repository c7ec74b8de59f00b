#!/usr/bin/env python3
"""Lists the licences of everything that the program `rheotaxis` and its Python module link, and says whether they allow it.

    python3 tools/licences.py            # a table: crate, version, licence
    python3 tools/licences.py --all      # every platform and feature of the lock file, not only this machine's build

The exit code is 0 when every licence is compatible with "MIT OR Apache-2.0", 1 when one is not, 2 when cargo fails.
Needs Python 3 and cargo, nothing else. It follows normal dependencies only: what builds or tests the program is not
part of it. (Macros are normal dependencies for cargo, so they are listed although nothing of them is linked.)
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = "rheotaxis"

# Licences under which a program that is itself "MIT OR Apache-2.0" may link code. MPL-2.0, EPL-2.0 and
# CDLA-Permissive-2.0 ask that their own files stay under their licence, which linking does not change.
ALLOWED = {
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "CDLA-Permissive-2.0",
    "EPL-2.0",
    "ISC",
    "MIT",
    "MIT-0",
    "MPL-2.0",
    "OFL-1.1",
    "Unicode-3.0",
    "Unicode-DFS-2016",
    "Unlicense",
    "Zlib",
    "bzip2-1.0.6",
    "libtiff",
}

# Files in this repository that are not ours, with the file that holds their licence.
FILES = [
    (
        "scenarios/output/src/charts/font/*.ttf",
        "scenarios/output/src/charts/font/LICENSE",
        "DejaVu Sans (Bitstream Vera licence)",
    ),
]


class Malformed(Exception):
    """The text is not an SPDX expression."""


def allowed(expression):
    """Whether an SPDX expression is met by ALLOWED: one side of OR suffices, both sides of AND are needed."""
    # "MIT/Apache-2.0" is what crates wrote before SPDX expressions; it means OR.
    tokens = re.findall(r"[()]|[^\s()]+", expression.replace("/", " OR "))
    value, rest = either(tokens)
    if rest:
        raise Malformed(f"`{rest[0]}` is left over in `{expression}`")
    return value


def either(tokens):
    """A OR B …"""
    value, rest = both(tokens)
    while rest and rest[0].upper() == "OR":
        other, rest = both(rest[1:])
        value = value or other
    return value, rest


def both(tokens):
    """A AND B …, which binds closer than OR."""
    value, rest = single(tokens)
    while rest and rest[0].upper() == "AND":
        other, rest = single(rest[1:])
        value = value and other
    return value, rest


def single(tokens):
    """One licence, with its exception if it has one, or an expression in parentheses."""
    if not tokens or tokens[0] == ")" or tokens[0].upper() in ("OR", "AND", "WITH"):
        raise Malformed("a licence is missing")
    if tokens[0] == "(":
        value, rest = either(tokens[1:])
        if not rest or rest[0] != ")":
            raise Malformed("`)` is missing")
        return value, rest[1:]
    name, rest = tokens[0], tokens[1:]
    if rest and rest[0].upper() == "WITH":
        if len(rest) < 2:
            raise Malformed("an exception is missing after WITH")
        name, rest = f"{name} WITH {rest[1]}", rest[2:]
    return name in ALLOWED, rest


def metadata(everything):
    """What cargo knows of the workspace; from the network only what is not on this machine yet."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    if everything:
        command.append("--all-features")
    else:
        version = subprocess.run(["rustc", "-vV"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        command += ["--filter-platform", re.search(r"^host: (\S+)", version, re.MULTILINE).group(1)]
    for offline in (["--offline"], []):
        done = subprocess.run(command + offline, cwd=ROOT, capture_output=True, text=True)
        if done.returncode == 0:
            return json.loads(done.stdout)
    sys.stderr.write(done.stderr)
    sys.exit(2)


def linked(known):
    """The packages that program and Python module reach through normal dependencies, without those of the workspace."""
    members = set(known["workspace_members"])
    packages = {package["id"]: package for package in known["packages"]}
    nodes = {node["id"]: node for node in known["resolve"]["nodes"]}

    def makes_one(package):
        targets = package["targets"]
        return any("bin" in t["kind"] and t["name"] == PROGRAM or "cdylib" in t["kind"] for t in targets)

    seen, open_ = set(), [i for i in members if makes_one(packages[i])]
    while open_:
        here = open_.pop()
        if here in seen:
            continue
        seen.add(here)
        for dep in nodes[here]["deps"]:
            if any(kind["kind"] is None for kind in dep["dep_kinds"]):
                open_.append(dep["pkg"])
    found = [packages[i] for i in seen - members]
    return sorted(found, key=lambda p: (p["name"].lower(), p["version"]))


def judged(package):
    """(what is printed as the licence, whether it is compatible)"""
    expression = package["license"]
    if not expression:
        return (f"none given; see {package['license_file']}" if package["license_file"] else "none given"), False
    try:
        return expression, allowed(expression)
    except Malformed as fault:
        return f"{expression} ({fault})", False


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--all", action="store_true", help="every platform and every feature")
    rows = [(p["name"], p["version"], *judged(p)) for p in linked(metadata(parser.parse_args().all))]
    wide = [max(len(row[i]) for row in rows) for i in (0, 1)]
    for name, version, licence, good in rows:
        print(f"{name:{wide[0]}}  {version:{wide[1]}}  {licence}{'' if good else '  <-- NOT COMPATIBLE'}")
    bad = [f"{row[0]} {row[1]}" for row in rows if not row[3]]
    for pattern, licence, words in FILES:
        count = len(list(ROOT.glob(pattern)))
        there = (ROOT / licence).is_file()
        print(f"{pattern}: {count} files, {words}, {licence if there else licence + ' IS MISSING'}")
        if not there:
            bad.append(pattern)
    for name in ("LICENSE-MIT", "LICENSE-APACHE"):
        if not (ROOT / name).is_file():
            bad.append(f"{name} is missing")
    print(f"{len(rows)} crates, {len(bad)} faults" + (": " + ", ".join(bad) if bad else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
