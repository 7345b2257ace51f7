#!/bin/sh
# Fuzzes every solver, the hybrid RANSAC and every file reader, as many at a time as there are processor cores:
# sh test/fuzz/run.sh SECONDS [NAME ...]
#
# Starts from valid inputs (build/fuzz/seeds), those in test/fuzz/corpus and what earlier runs found (build/fuzz/corpus). An input
# that breaks a promise, or takes more than 30 seconds, is left in build/fuzz/faults; to see the fault again:
# build/fuzz/test/fuzz/NAME_fuzzer FILE, for a solver build/fuzz/test/fuzz/solver_fuzzer --solver=NAME FILE.
# Exit status 1 if there was one. HYBRIDGV_FUZZ_SEED (default: another one every time) makes a run repeatable, up to its length.
set -e
seconds=${1:?usage: run.sh SECONDS [NAME ...]}
shift
cd "$(dirname "$0")/../.."
sh .ci/install_packages.sh build clang
[ -f build/fuzz/CMakeCache.txt ] || cmake --preset fuzz -G Ninja -DHYBRIDGV_BUILD_TESTS=OFF >&2
cmake --build build/fuzz --target fuzzers >&2
build/fuzz/test/fuzz/make_seeds build/fuzz/seeds
solvers=$(build/fuzz/test/fuzz/solver_fuzzer --list)
[ $# -gt 0 ] || set -- $solvers hybrid_ransac colmap_text colmap_binary bundler nvm problem camera database

status=0
mkdir -p build/fuzz/rows
rm -f build/fuzz/rows/*
printf '%s\n' "$@" | xargs -n 1 -P "$(nproc)" sh test/fuzz/run_one.sh "$seconds" || status=1
printf '%-16s %12s %9s %9s %8s %s\n' target executions per_s coverage inputs result
for name; do
  cat build/fuzz/rows/"$name"
done
exit $status
