#!/usr/bin/env python3
"""Compares the speed of the plume with pompy's and with a plain loop, on one core of this machine.

    python3 -m venv .venv && .venv/bin/pip install -r tools/peers/requirements.txt
    .venv/bin/python tools/peers/compare.py

pompy (https://github.com/InsectRobotics/pompy, MIT) is the plume model of Farrell et al. 2002 in NumPy. Its puffs move
in a plane wind that is the same at all heights; ours move in sheared, stratified water between bed and surface. The
plain loop (`plumes/benches/filaments.rs`) moves our filaments by the same equations, one after the other, with the
water evaluated at each. All three have the same number of filaments.
"""

import re
import subprocess
import time

import numpy as np
from pompy import models

PUFFS = 10_000
SCALE = {"": 1.0, "K": 1e3, "M": 1e6, "G": 1e9}


def pompy_updates_a_second():
    """Puff updates a second of pompy, after it has filled its domain."""
    region = models.Rectangle(x_min=0.0, x_max=1000.0, y_min=-200.0, y_max=200.0)
    wind = models.WindModel(region, 21, 21, rng=np.random.RandomState(1))
    plume = models.PlumeModel(
        region,
        (5.0, 0.0, 0.0),
        wind,
        puff_release_rate=PUFFS,
        init_num_puffs=PUFFS,
        max_num_puffs=PUFFS,
        rng=np.random.RandomState(2),
    )
    dt, steps = 0.05, 20
    best = float("inf")
    for _ in range(5):
        begun = time.process_time()
        for _ in range(steps):
            wind.update(dt)
            plume.update(dt)
        best = min(best, time.process_time() - begun)
    moved = sum(1 for _ in plume.puffs)
    return moved * steps / best, moved


def ours(name):
    """Items a second of a benchmark of ours, the fastest of divan's samples, for the same number of filaments."""
    command = ["cargo", "bench", "-p", "plumes", "--bench", "filaments", "--", name]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    lines = text.splitlines()
    group = next(n for n, line in enumerate(lines) if re.search(rf"─ {name}\s", line))
    at = next(n for n in range(group, len(lines)) if re.search(rf"─ {PUFFS}\s", lines[n]))
    found = re.search(r"([0-9.]+) ([KMG]?)item/s", " ".join(lines[at : at + 2]))
    return float(found.group(1)) * SCALE[found.group(2)]


def main():
    pompy, puffs = pompy_updates_a_second()
    plain, kernel = ours("plain_loop"), ours("drift")
    print(f"filament updates a second with {PUFFS} filaments on one core")
    print("| program | updates/s | ours is faster by |")
    print("|---|---|---|")
    print(f"| rheotaxis | {kernel:.2g} | 1 |")
    print(f"| plain loop, same equations | {plain:.2g} | {kernel / plain:.0f} |")
    print(f"| pompy, {puffs} puffs in a plane | {pompy:.2g} | {kernel / pompy:.0f} |")


if __name__ == "__main__":
    main()
