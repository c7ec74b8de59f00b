#!/usr/bin/env bash
# Does what README says under "To add an algorithm", in a copy of the tree: applies docs/add_an_algorithm.patch, builds,
# and uses the new behaviour in a scenario. The copy shares the target folder, so that no dependency is built twice.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
target=$(cargo metadata --format-version 1 --no-deps | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
copy=$target/add_an_algorithm
export CARGO_TARGET_DIR=$target

fail() { echo "check_add_an_algorithm: $*" >&2; exit 1; }

# The times of the files stay: what the patch leaves alone is built once.
rm -rf "$copy"
mkdir -p "$copy"
git ls-files -z --cached --others --exclude-standard |
    while IFS= read -r -d '' file; do if [ -e "$file" ]; then printf '%s\0' "$file"; fi; done |
    tar --null --files-from=- --create --file=- | tar --extract --preserve-permissions --directory "$copy" --file=-
# The copy's program takes the place of the tree's own: put that back in any case.
restore() { (cd "$root" && cargo build --release --quiet --package command); rm -rf "$copy"; }
trap restore EXIT
cd "$copy"
patch --strip=1 --fuzz=2 < docs/add_an_algorithm.patch
rustfmt --edition 2024 --check robots/src/behave/spiral.rs

cargo build --release --package command 2>&1 | tee build.log
! grep --quiet '^warning' build.log || fail "the example does not compile without warnings"
rheotaxis=$target/release/rheotaxis

"$rheotaxis" list algorithms | grep --quiet "^  Spiral " || fail "list does not name Spiral"
"$rheotaxis" explain robots.strategy.Amp.reacquire.Spiral.spacing_m | grep --quiet "default  8" ||
    fail "explain does not say the default of spacing_m"

# The scenario that README shows: two runs that differ in nothing but how they reacquire the plume.
shown=$(sed -n 's/^strategy: \(Amp(.*Spiral(.*)\),$/\1/p' README.md)
[ -n "$shown" ] || fail "README shows no strategy with Spiral"
runs=$(mktemp -d)
"$rheotaxis" init uniform_channel "$runs/bowtie.ron" > /dev/null
grep --quiet "strategy: Amp(.*)," "$runs/bowtie.ron" || fail "uniform_channel has no strategy on a line of its own"
sed "s/strategy: Amp(.*),/strategy: $shown,/" "$runs/bowtie.ron" > "$runs/spiral.ron"
for name in bowtie spiral; do
    "$rheotaxis" check "$runs/$name.ron"
    code=0
    "$rheotaxis" run "$runs/$name.ron" --quiet --no-zenoh --out "$runs/$name" || code=$?
    # 3: the mission ran to its end and found nothing.
    [ "$code" = 0 ] || [ "$code" = 3 ] || fail "the run of $name.ron ended with exit code $code"
done
digest() { grep --max-count=1 '"digest"' "$runs/$1/summary.json"; }
[ "$(digest bowtie)" != "$(digest spiral)" ] || fail "both behaviours gave the same run: Spiral was never entered"
rm -rf "$runs"
echo "README's example compiles, is listed and explained, and flies"
