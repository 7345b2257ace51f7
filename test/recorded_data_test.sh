#!/bin/sh
# recorded_data.sh takes the data beside the project, and no folder that merely has the same name.
project=$(cd "$(dirname "$0")/.." && pwd)
scratch=$(mktemp -d) && trap 'rm -rf "$scratch"' EXIT
unset HYBRIDGV_REALDATA_DIR HYBRIDGV_GOLDEN_DIR
found() {
  (cd "$scratch/main" && . "$project/test/recorded_data.sh" >/dev/null && echo "$HYBRIDGV_REALDATA_DIR $HYBRIDGV_GOLDEN_DIR")
}
expect() { [ "$(found)" = "$1" ] || { echo "FAILED: found $(found), not $1"; exit 1; }; }

mkdir -p "$scratch/main" "$scratch/shared/realdata" "$scratch/shared/golden"
expect " "
mkdir "$scratch/shared/realdata/kermit"
touch "$scratch/shared/realdata/kermit/bundle.out" "$scratch/shared/golden/h13f.txt"
expect "$scratch/shared/realdata $scratch/shared/golden"
HYBRIDGV_GOLDEN_DIR=/elsewhere
expect "$scratch/shared/realdata /elsewhere"
echo passed
