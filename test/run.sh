#!/bin/sh
# Installs what is missing (Debian packages), builds everything and runs all tests. Arguments go to ctest: sh test/run.sh -R H13f
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh g++ cmake ninja-build pkg-config libeigen3-dev libopengv-dev libgtest-dev libbenchmark-dev libcli11-dev nlohmann-json3-dev \
  gnuplot-nox parallel
jobs=$(nproc)
strict=OFF
[ "$CI" != true ] || strict=ON
cmake -S . -B build/test -G Ninja -DHYBRIDGV_WERROR=$strict
cmake --build build/test -j "$jobs"
ctest --test-dir build/test -j "$jobs" --output-on-failure "$@"
