#!/bin/sh
# Runs a campaign with GNU parallel: here, or on the hosts of a file (ssh; DIR and the program seen by all).
#
#   docs/cluster/gnu_parallel.sh CAMPAIGN DIR SHARDS [--sshloginfile HOSTS] [more options of parallel]
#
# A shard that stops in order (exit 75) or fails is started again; what is done is not done again.
# PROGRAM, BLOCK (runs in a block; without it by their cost) and JOBS (runs at a time in a shard) may be set in the environment.
set -eu
campaign=$1 dir=$2 shards=$3
shift 3
exec parallel --will-cite --halt soon,fail=50% --retries 5 "$@" \
    "${PROGRAM:-rheotaxis}" campaign run "$campaign" --out "$dir" --shard "{}/$shards" \
    --jobs "${JOBS:-1}" ${BLOCK:+--block "$BLOCK"} --quiet ::: $(seq "$shards")
