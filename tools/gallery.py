#!/usr/bin/env python3
"""Makes the pictures of docs/gallery.md with the commands that stand below them.

    tools/gallery.py                       # all, into docs/figures
    tools/gallery.py --check duck_map      # says whether that one is out of date, and writes nothing

The commands of a block run in an empty folder, all blocks in the same one, so that a run is made once. A comment in a
block names the file that is the picture; several pictures above a block are its comments in order.

--check compares bytes first. A run gives the same picture on every machine, so one of another shape, or with a pixel
of another colour, is out of date. Pictures of a browser (the look) are compared by their means over 16 x 16 parts,
because browsers draw letters and edges differently. What is measured in seconds is not compared. The exit code is 0 if
nothing is out of date, 1 if something is, or could not be made.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import png

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/gallery.md"
FIGURES = ROOT / "docs/figures"
# A picture of a browser is the same if no part of it is farther off, levels of 255.
ALIKE = 12
# Exit code 3: a mission that ended without success has its pictures, too. A run that is there is not made again.
SHELL = """
rheotaxis() {
    if [ "$1" = run ] && [ -d "runs/$2-1" ]; then return 0; fi
    "$PROGRAM" "$@" || [ $? -eq 3 ]
}
cargo() { verb=$1; shift; command cargo "$verb" --manifest-path "$ROOT/Cargo.toml" "$@"; }
python() { "$PYTHON" "$@"; }
"""


def blocks(page):
    """(names of pictures, commands, files) of each block."""
    lines, names, inside = [], [], False
    for line in page.splitlines():
        if line.startswith("```"):
            if inside:
                files = re.findall(r"# (\S+)$", "\n".join(lines), re.M)
                if len(files) != len(names):
                    sys.exit(f"docs/gallery.md: {names or 'a block'}: {len(files)} files for {len(names)} pictures")
                yield names, "\n".join(lines), files
                names = []
            lines, inside = [], not inside
        elif inside:
            lines.append(line)
        else:
            names += re.findall(r"^!\[.*\]\(figures/(.+)\)$", line)
    if names:
        sys.exit(f"docs/gallery.md: no commands below {names}")


def parts(path):
    width, height, rows = png.read(path)
    return width, height, b"".join(png.smaller(width, rows, 16, 16))


def difference(old, new, commands):
    """Why the picture is out of date; None if it is not."""
    if not old.exists():
        return "missing"
    if old.read_bytes() == new.read_bytes() or "studies scale" in commands:
        return None
    if new.suffix != ".png":
        return "other bytes"
    if "rheotaxis.look" in commands:
        (w, h, a), (v, g, b) = parts(old), parts(new)
        farthest = max(abs(x - y) for x, y in zip(a, b))
        return None if (w, h) == (v, g) and farthest <= ALIKE else f"{v} x {g} px for {w} x {h}, off by {farthest}"
    (w, h, a), (v, g, b) = png.read(old), png.read(new)
    if (w, h) != (v, g):
        return f"{v} x {g} px in the place of {w} x {h}"
    a, b = b"".join(a), b"".join(b)
    if a == b:
        return None
    changed = sum(a[i : i + 3] != b[i : i + 3] for i in range(0, len(a), 3))
    return f"{100 * changed / (w * h):.2f} % of the pixels differ"


def made(folder, commands, settings):
    """Runs the commands of a block; what went wrong, or None."""
    if "-m rheotaxis.look" in commands:
        there = subprocess.run([settings["PYTHON"], "-c", "import rheotaxis.look"], capture_output=True)
        if there.returncode != 0:
            return f"{settings['PYTHON']} has no rheotaxis.look (--python)"
    shell = ["sh", "-e", "-c", SHELL + commands]
    end = subprocess.run(shell, cwd=folder, env=os.environ | settings, capture_output=True, text=True)
    return f"exit code {end.returncode}\n{end.stderr[-1000:]}" if end.returncode else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="pictures, such as duck_map; default: all")
    parser.add_argument("--program", default=ROOT / "target/release/rheotaxis", type=Path, help="the built rheotaxis")
    parser.add_argument("--python", default="python3", help="a Python with rheotaxis[look]")
    parser.add_argument("--check", action="store_true", help="compare, and write nothing into docs/figures")
    parser.add_argument("--skip", action="append", default=[], help="leave out this picture")
    args = parser.parse_args()
    if not args.program.is_file():
        sys.exit(f"{args.program} is not there: build it, or name it with --program")
    wanted = [
        block
        for block in blocks(PAGE.read_text())
        for stems in [{Path(name).stem for name in block[0]}]
        if stems and not stems & set(args.skip) and (not args.names or stems & set(args.names))
    ]
    unknown = set(args.names) - {Path(name).stem for names, _, _ in wanted for name in names}
    if unknown:
        sys.exit(f"docs/gallery.md has no {', '.join(sorted(unknown))}")
    bad = 0
    with tempfile.TemporaryDirectory() as folder:
        for name in ["scenarios", "tools"]:
            (Path(folder) / name).symlink_to(ROOT / name)
        settings = {"PROGRAM": str(args.program.resolve()), "PYTHON": args.python, "ROOT": str(ROOT)}
        settings["RHEOTAXIS_CACHE"] = str(Path(folder) / "cache")
        for names, commands, files in wanted:
            fault = made(folder, commands, settings)
            for name, file in zip(names, files):
                new, old = Path(folder) / file, FIGURES / name
                said = fault or (None if new.is_file() else f"the commands leave no {file}")
                if said:
                    bad += 1
                    print(f"{name}: not made: {said}")
                    continue
                said = difference(old, new, commands)
                bad += bool(said and args.check)
                verdict = "out of date" if args.check else "made anew"
                print(f"{name}: {f'{verdict}: {said}' if said else 'up to date'}", flush=True)
                if said and not args.check:
                    shutil.copyfile(new, old)
    sys.exit(min(bad, 1))


if __name__ == "__main__":
    main()
