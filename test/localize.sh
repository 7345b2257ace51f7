#!/bin/sh
# usage: localize.sh PROGRAM MAP   the program on the default map and on wrong input
program=$1 map=$2
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }

"$program" --json --outliers 0.3 --seed 3 > "$scratch/all" || fail "default map"
[ "$(wc -l < "$scratch/all")" = "$(grep -c '"query"' "$scratch/all")" ] || fail "one object a line"
[ "$(grep -c '"hybrid":{"success":true' "$scratch/all")" = 16 ] || fail "all 16 images localized with 30 % outliers"

# Queries from standard input give the same objects, times aside.
without_times() { sed 's/"seconds":[^},]*//g' "$1" | sort; }
sed 's/.*"query":"\([^"]*\)".*/\1/' "$scratch/all" | "$program" "$map" --stdin --json --outliers 0.3 --seed 3 > "$scratch/stdin"
without_times "$scratch/all" > "$scratch/a" && without_times "$scratch/stdin" > "$scratch/b"
cmp "$scratch/a" "$scratch/b" || fail "--stdin"

"$program" "$map" --query photo_03.jpg 4 --solver h13f | grep -q '^photo_03.jpg' || fail "--query and --solver"
"$program" --help | grep -q -- '--outliers' || fail "--help"
"$program" --help | tr -s '\n ' ' ' | grep -q 'all, p4pf, .*h51f' || fail "--help lists the solvers"
expect_error() {
  message=$1 && shift
  "$program" "$@" > "$scratch/out" 2> "$scratch/error" && fail "$* must fail"
  grep -q "$message" "$scratch/error" || fail "$* must name $message: $(cat "$scratch/error")"
}
expect_error "no/such/map" no/such/map
expect_error "nobody.jpg" "$map" --query nobody.jpg
expect_error "h99f" --solver h99f
expect_error "share" --outliers 2
expect_error "maxReprojectionErrorPx" --max-reprojection-error -1
echo "query 1 2 3" > "$scratch/broken.txt"
expect_error "broken.txt:1" "$scratch/broken.txt"
echo passed
