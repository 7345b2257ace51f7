#!/bin/sh
# Fuzzes every solver, the hybrid RANSAC and every file reader, one after the other: sh test/fuzz/run.sh SECONDS [NAME ...]
#
# Starts from the inputs in test/fuzz/corpus and from what earlier runs found (build/fuzz/corpus). An input that breaks a promise,
# or takes more than 30 seconds, is left in build/fuzz/faults; to see the fault again: build/fuzz/test/fuzz/NAME_fuzzer FILE.
# Exit status 1 if there was one. HYBRIDGV_FUZZ_SEED (default: another one every time) makes a run repeatable, up to its length.
set -e
seconds=${1:?usage: run.sh SECONDS [NAME ...]}
shift
cd "$(dirname "$0")/../.."
sh .ci/install_packages.sh clang-14 libclang-rt-14-dev cmake ninja-build libeigen3-dev
[ -f build/fuzz/CMakeCache.txt ] || cmake --preset fuzz -G Ninja -DHYBRIDGV_BUILD_TESTS=OFF >&2
cmake --build build/fuzz --target fuzzers >&2
[ $# -gt 0 ] || set -- p4pf p35pf h13f h32f h51f sixpt_onefocal hybrid_ransac colmap_text colmap_binary bundler nvm problem

status=0
mkdir -p build/fuzz/faults
printf '%-16s %12s %9s %9s %8s %s\n' target executions per_s coverage inputs result
for name; do
  corpus=build/fuzz/corpus/$name log=build/fuzz/$name.log
  mkdir -p "$corpus"
  result=clean
  # Not all of them use the words of the dictionary, which is no harm.
  build/fuzz/test/fuzz/"$name"_fuzzer -seed="${HYBRIDGV_FUZZ_SEED:-0}" -max_total_time="$seconds" -timeout=30 -rss_limit_mb=2048 -malloc_limit_mb=256 \
    -max_len=4096 -dict=test/fuzz/readers.dict -print_final_stats=1 -artifact_prefix=build/fuzz/faults/"$name"- \
    "$corpus" test/fuzz/corpus/"$name" 2>"$log" || { result="FAULT, see $log"; status=1; }
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  coverage=$(sed -n 's/^#.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -1)
  printf '%-16s %12s %9s %9s %8s %s\n' "$name" "$executions" "$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")" \
    "$coverage" "$(ls "$corpus" | wc -l)" "$result"
done
exit $status
