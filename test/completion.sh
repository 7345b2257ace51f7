#!/bin/sh
# usage: completion.sh PROGRAM COMPLETION   what bash offers after a part of a command line
if ! command -v bash > /dev/null; then
  echo "bash is missing: skipped"
  exit 77
fi
PROGRAM=$1 COMPLETION=$2 exec bash << 'END'
. "$COMPLETION"
offered() { COMP_WORDS=("$PROGRAM" "$@"); COMP_CWORD=$#; _hybridgv; echo "${COMPREPLY[*]}"; }
expect() {
  wanted=$1 && shift
  [[ " $(offered "$@") " == *" $wanted "* ]] || { echo "FAILED: $* offers '$(offered "$@")', not $wanted"; exit 1; }
}
expect image_registrator im
expect localize ""
expect --database_path image_registrator --d
expect --Mapper.min_num_matches image_registrator --Mapper.min
expect --outliers localize --out
expect BIN image_registrator --output_type ""
expect matches image_registrator --matches m
echo passed
END
