#!/bin/sh
# usage: localize_parallel.sh PROGRAM MAP   the images of a map, shared out by GNU parallel among one and among four jobs, must give
# the same objects, times aside
program=$1 map=$2
if ! parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
  echo "GNU parallel is missing (Debian package parallel): skipped"
  exit 77
fi
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
names=$(seq -f photo_%02g.jpg 1 16)
for jobs in 1 4; do
  echo "$names" | parallel --will-cite --jobs $jobs --pipe -N 3 "$program" "$map" --stdin --json --outliers 0.3 --seed 3 > "$scratch/out" ||
    fail "$jobs jobs"
  [ "$(wc -l < "$scratch/out")" = 16 ] || fail "one object for each of 16 images with $jobs jobs"
  sed 's/"seconds":[^},]*//g' "$scratch/out" | sort > "$scratch/$jobs"
done
cmp "$scratch/1" "$scratch/4" || fail "one and four jobs differ"
echo passed
