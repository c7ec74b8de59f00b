#!/bin/sh
# Runs the recipes for GNU parallel and Ray on a small campaign and compares their rows with those of one process.
# Not part of the quick tests. It needs GNU parallel and a Python (PYTHON) with ray, duckdb and polars, and takes about
# two minutes.
#
#   cargo build --release && tools/check_cluster.sh
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
PROGRAM=${PROGRAM:-$root/target/release/rheotaxis}
PYTHON=${PYTHON:-python3}
export PROGRAM RHEOTAXIS_NO_CACHE=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

sed 's/seeds: 10,/seeds: 3,/' "$root/scenarios/catalog/campaigns/uniform_beta.ron" > small.ron
grep -q 'seeds: 3,' small.ron
"$PROGRAM" campaign run small.ron --out one --block 12 --jobs 1 --quiet

# Each shard of the recipes is stopped at its first try; the recipes must start it again.
cat > stopped_once <<END
#!/bin/sh
mark=$work/tried-\$(echo "\$*" | cksum | cut -d' ' -f1)
if [ -e "\$mark" ]; then exec "$PROGRAM" "\$@"; fi
touch "\$mark"
exit 75
END
chmod +x stopped_once
PROGRAM=$work/stopped_once
BLOCK=2 "$root/docs/cluster/gnu_parallel.sh" small.ron parallel 3 -j 2
"$PYTHON" "$root/docs/cluster/ray_campaign.py" small.ron --out ray --shards 3 --block 2 --program "$PROGRAM"

"$PYTHON" - <<'PY'
import duckdb

ROWS = "SELECT * EXCLUDE (spin_up_wall_s, mission_wall_s) FROM read_parquet('{}/part-*.parquet')"


def ask(query):
    return duckdb.execute(query).fetchall()


one = ROWS.format("one")
n = ask(f"SELECT count(*), count(DISTINCT run), count(error) FROM ({one})")
assert n == [(12, 12, 0)], n
for other in ["parallel", "ray"]:
    blocks = ask(f"SELECT count(*) FROM glob('{other}/part-*.parquet')")
    assert blocks == [(6,)], (other, blocks)
    theirs = ROWS.format(other)
    said = "SELECT * FROM read_parquet('{}/declarations-*.parquet')"
    for ours, other_ones in [(one, theirs), (said.format("one"), said.format(other))]:
        for a, b in [(ours, other_ones), (other_ones, ours)]:
            odd = ask(f"({a}) EXCEPT ALL ({b})")
            assert not odd, (other, odd)
    print(f"{other}: the same 12 rows as one process")
PY
test "$(find "$work" -name 'tried-*' | wc -l)" -eq 6
cd ray
"$PYTHON" -c "
import duckdb, sys
for query in open(sys.argv[1]).read().split(';'):
    if query.strip():
        duckdb.sql(query).show()
" "$root/docs/cluster/queries.sql"
"$PYTHON" "$root/docs/cluster/queries.py" .
