#!/usr/bin/env bash
# Builds and runs the crate of docs/own_crate.md, from that page alone and outside the workspace.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
target=${CARGO_TARGET_DIR:-$root/target}/own_crate
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$root/docs/own_crate.md" | sed '1d;$d'; }
mkdir -p "$work/mine/src"
ln -s "$root" "$work/rheotaxis"
block toml > "$work/mine/Cargo.toml"
block rust > "$work/mine/src/main.rs"
cp "$root/Cargo.lock" "$work/mine/Cargo.lock"
cd "$work/mine"
CARGO_TARGET_DIR=$target RUSTFLAGS="-D warnings" cargo run 2>&1 | tee "$work/said"
grep --quiet ' after [0-9]* s$' "$work/said" || { echo "the crate's run did not end" >&2; exit 1; }
echo "docs/own_crate.md builds with one dependency, and runs"
