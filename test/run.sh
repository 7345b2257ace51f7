#!/bin/sh
# Installs what is missing (Debian packages), builds everything and runs all tests. Arguments go to ctest: sh test/run.sh -R H13f
# Recorded data are read from the folders that recorded_data.sh finds.
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh build tests benchmarks examples program python pictures parallel
. test/recorded_data.sh
jobs=$(nproc)
strict=OFF
[ "$CI" != true ] || strict=ON
cmake -S . -B build/test -G Ninja -DHYBRIDGV_WERROR=$strict -DHYBRIDGV_PRECOMPILED_HEADERS=$strict -DHYBRIDGV_REALDATA_DIR="$HYBRIDGV_REALDATA_DIR" \
  -DHYBRIDGV_GOLDEN_DIR="$HYBRIDGV_GOLDEN_DIR"
cmake --build build/test -j "$jobs"
ctest --test-dir build/test -j "$jobs" --output-on-failure "$@"
