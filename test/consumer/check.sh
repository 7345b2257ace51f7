#!/bin/sh
# usage: check.sh BUILD_DIR "TARGET .. PROGRAM" [cmake options]   builds targets of this project in a fresh folder, runs the last one
set -e
build=$1 targets=$2 program=$1/${2##* }
shift 2
rm -rf "$build"
cmake -S "$(dirname "$0")" -B "$build" "$@"
cmake --build "$build" --target $targets
[ ! -x "$program" ] || "$program"
