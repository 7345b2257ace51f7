#!/bin/sh
# usage: run_one.sh SECONDS NAME   for run.sh: fuzzes one target and leaves its row of the table in build/fuzz/rows
# Exit status 1 if it found a fault.
seconds=$1 name=$2
corpus=build/fuzz/corpus/$name log=build/fuzz/$name.log
mkdir -p "$corpus" build/fuzz/faults
result=clean status=0
program=build/fuzz/test/fuzz/${name}_fuzzer
[ -x "$program" ] || program="build/fuzz/test/fuzz/solver_fuzzer --solver=$name"
committed=test/fuzz/corpus/$name
[ -d "$committed" ] || committed=
# Not all of them use the words of the dictionary, which is no harm.
$program -seed="${HYBRIDGV_FUZZ_SEED:-0}" -max_total_time="$seconds" -timeout=30 -rss_limit_mb=2048 -malloc_limit_mb=256 \
  -max_len=4096 -dict=test/fuzz/readers.dict -print_final_stats=1 -artifact_prefix=build/fuzz/faults/"$name"- \
  "$corpus" $committed build/fuzz/seeds/"$name" 2>"$log" || { result="FAULT, see $log"; status=1; }
executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
coverage=$(sed -n 's/^#.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -1)
printf '%-16s %12s %9s %9s %8s %s\n' "$name" "$executions" "$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")" \
  "$coverage" "$(ls "$corpus" | wc -l)" "$result" >build/fuzz/rows/"$name"
exit $status
