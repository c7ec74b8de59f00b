#!/bin/sh
# Runs a campaign with GNU parallel, on this machine or on the hosts of a file (by ssh). All hosts must see DIR and have
# the program.
#
#   docs/cluster/gnu_parallel.sh CAMPAIGN DIR SHARDS [--sshloginfile HOSTS] [more options of parallel]
#
# A shard that stops with exit code 75, or that fails, is started again; runs that are done are not repeated.
# Environment variables: PROGRAM; BLOCK, the runs in a block (by default from their cost); JOBS, the number of runs
# that a shard makes at a time.
set -eu
campaign=$1 dir=$2 shards=$3
shift 3
exec parallel --will-cite --halt soon,fail=50% --retries 5 "$@" \
    "${PROGRAM:-rheotaxis}" campaign run "$campaign" --out "$dir" --shard "{}/$shards" \
    --jobs "${JOBS:-1}" ${BLOCK:+--block "$BLOCK"} --quiet ::: $(seq "$shards")
