#!/bin/sh
# usage: installs_own_files_only.sh BUILD_DIR HYBRIDGV_SOURCE_DIR [cmake options]
# A project that contains the sources of HybridGV installs its own library and nothing of HybridGV.
set -e
build=$1 sources=$2
shift 2
rm -rf "$build"
cmake -S "$(dirname "$0")" -B "$build" -DHYBRIDGV_SOURCE_DIR="$sources" "$@"
cmake --build "$build" --target own
cmake --install "$build" --prefix "$build/prefix"
installed=$(cd "$build/prefix" && find . -type f)
[ "$installed" = ./lib/libown.a ] || { echo "installed: $installed"; exit 1; }
