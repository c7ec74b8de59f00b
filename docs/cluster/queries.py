#!/usr/bin/env python3
"""The queries of queries.sql in Polars: python queries.py DIR [ARM OTHER_ARM]"""

import sys

import polars as pl

folder = sys.argv[1]
arm, other = sys.argv[2:4] if len(sys.argv) > 3 else ("beta20", "beta45")
runs = pl.scan_parquet(f"{folder}/part-*.parquet")
good = runs.filter(pl.col("error").is_null())

# Success with its number of runs, by condition and arm.
by = ["condition", "arm"]
print(
    good.group_by(by)
    .agg(pl.len().alias("runs"), pl.col("success").mean().alias("share"), pl.col("error_m", "declared_s").median())
    .sort(by)
    .collect()
)

# Paired difference of two arms over the same seeds and conditions.
key = ["condition", "seed_index"]
pairs = good.filter(pl.col("arm") == arm).join(good.filter(pl.col("arm") == other), on=key, suffix="_other")
gain = pl.col("success").cast(pl.Int8) - pl.col("success_other").cast(pl.Int8)
longer = pl.col("declared_s") - pl.col("declared_s_other")
print(
    pairs.select(
        pl.len().alias("pairs"),
        gain.mean().alias("gain"),
        (gain.std() / gain.count().sqrt()).alias("gain_se"),
        longer.count().alias("both_declared"),
        longer.mean().alias("longer_s"),
        (longer.std() / longer.count().sqrt()).alias("longer_se_s"),
    ).collect()
)

# Where the wall time went, s.
wall = pl.col("spin_up_wall_s")
print(
    runs.group_by("arm")
    .agg(pl.len().alias("runs"), (wall > 0).sum().alias("spin_ups_paid"), pl.col("spin_up_wall_s", "mission_wall_s").sum())
    .sort("arm")
    .collect()
)

# Declarations by rule and verdict. The join leaves out those of runs that have no row yet.
declared = pl.scan_parquet(f"{folder}/declarations-*.parquet").join(runs.select("run"), on="run")
by = ["arm", "rule", "verdict"]
print(
    declared.group_by(by)
    .agg(pl.len().alias("declarations"), pl.col("run").n_unique().alias("runs"), pl.col("error_m").median())
    .sort(by)
    .collect()
)
