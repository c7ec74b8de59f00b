#!/usr/bin/env bash
# Does what docs/add_an_algorithm.md says, in a copy of the tree: applies docs/add_an_algorithm.patch, builds,
# and uses the new behaviour in a scenario. The copy shares the target folder, so that no dependency is built twice.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
target=$(cargo metadata --format-version 1 --no-deps | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
copy=$target/add_an_algorithm
export CARGO_TARGET_DIR=$target CARGO_TERM_COLOR=never RHEOTAXIS_NO_CACHE=1

fail() { echo "check_add_an_algorithm: $*" >&2; exit 1; }

# cargo tells crates apart by their path from the workspace's root. In the copy they lie one folder deeper, so that they
# do not take the place of the tree's own. File times stay, so that a second check builds only what the patch changes.
rm -rf "$copy"
mkdir -p "$copy/tree"
git ls-files -z --cached --others --exclude-standard |
    while IFS= read -r -d '' file; do if [ -e "$file" ]; then printf '%s\0' "$file"; fi; done |
    tar --null --files-from=- --create --file=- | tar --extract --preserve-permissions --directory "$copy/tree" --file=-
sed -e '/^\(default-\)\{0,1\}members = \[/,/^\]/ s#"\(.*\)"#"tree/\1"#' -e 's#path = "#path = "tree/#' \
    "$copy/tree/Cargo.toml" > "$copy/Cargo.toml"
mv "$copy/tree/Cargo.lock" "$copy/Cargo.lock"
rm "$copy/tree/Cargo.toml"
runs=$(mktemp -d)
# The program of the copy has the name of the tree's own: put that back in any case.
restore() { rm -rf "$runs" "$copy"; (cd "$root" && cargo build --release --quiet --package rheotaxis-command); }
trap restore EXIT

cd "$copy/tree"
patch --strip=1 --fuzz=2 < docs/add_an_algorithm.patch
rustfmt --edition 2024 --check robots/src/behave/spiral.rs
cd "$copy"
cargo build --release --locked --package rheotaxis-command 2>&1 | tee "$runs/build.log"
! grep --quiet '^warning' "$runs/build.log" || fail "the example does not compile without warnings"

rheotaxis=$target/release/rheotaxis
"$rheotaxis" list algorithms | grep --quiet "^  Spiral " || fail "list does not name Spiral"
"$rheotaxis" explain robots.strategy.Amp.reacquire.Spiral.spacing_m | grep --quiet "default  8" ||
    fail "explain does not say the default of spacing_m"

# The scenario that the page shows, and the one it comes from: they differ in nothing but how they reacquire the plume.
shown=$(sed -n 's/^strategy: \(Amp(.*Spiral(.*)\),$/\1/p' tree/docs/add_an_algorithm.md)
[ -n "$shown" ] || fail "the page shows no strategy with Spiral"
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
echo "The example compiles, is listed and explained, and flies"
