#!/usr/bin/env python3
"""Tests whether two versions of the program give equivalent statistics.

    tools/equivalence.py BEFORE.csv AFTER.csv [BEFORE.csv AFTER.csv ...]

Each file holds the rows of a campaign (`rheotaxis campaign merge DIR -o FILE.parquet --csv`). For each pair and each
quantity, two one-sided tests (Schuirmann 1987, J. Pharmacokinet. Biopharm. 15, 657) at 5 % divided by the number of
comparisons (Bonferroni) ask whether the difference lies within a margin that was fixed beforehand. Normal
approximation; n is some hundred.
"""

import csv
import math
import statistics
import sys

# Quantity, column, margin, and whether the margin is a part of the value before.
QUANTITIES = [
    ("success, share", "success", 0.10, False),
    ("mission, s", "mission_s", 0.15, True),
    ("declared at, s", "declared_s", 0.15, True),
    ("detections", "detections", 0.20, True),
    ("error, m", "error_m", 0.25, True),
]


def column(path, name):
    """The numbers of a column; empty fields are left out."""
    with open(path, newline="") as file:
        texts = [row[name] for row in csv.DictReader(file)]
    words = {"true": 1.0, "false": 0.0}
    return [words[t] if t in words else float(t) for t in texts if t]


def compared(pairs):
    """One row for each pair and quantity that both have."""
    rows = []
    for before, after in pairs:
        for title, name, margin, relative in QUANTITIES:
            a, b = column(before, name), column(after, name)
            if len(a) < 20 or len(b) < 20 or (name != "success" and len(set(a)) < 2):
                continue
            ma, mb = statistics.fmean(a), statistics.fmean(b)
            error = math.sqrt(statistics.variance(a) / len(a) + statistics.variance(b) / len(b))
            bound = margin * abs(ma) if relative else margin
            rows.append((before, title, len(a), len(b), ma, mb, error, bound))
    return rows


def main(paths):
    if len(paths) < 2 or len(paths) % 2:
        sys.exit(__doc__)
    rows = compared(list(zip(paths[::2], paths[1::2])))
    level = 0.05 / max(len(rows), 1)
    z = statistics.NormalDist().inv_cdf(1.0 - level)
    print(f"{len(rows)} comparisons, each at {100 * level:.2f} %: difference +- {z:.2f} standard errors")
    print("| pair | quantity | n | before | after | difference | margin | equivalent |")
    print("|---|---|---|---|---|---|---|---|")
    failed = 0
    for before, title, n, m, ma, mb, error, bound in rows:
        name = before.rsplit("/", 1)[-1].removesuffix(".csv")
        inside = abs(mb - ma) + z * error < bound
        failed += not inside
        print(
            f"| {name} | {title} | {n}, {m} | {ma:.4g} | {mb:.4g} | {mb - ma:+.3g} +- {z * error:.2g} "
            f"| {bound:.3g} | {'yes' if inside else 'not shown'} |"
        )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
