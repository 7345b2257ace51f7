#!/bin/sh
# Installs what is missing, builds the library alone and leaves the Debian packages libhybridgv0.1 and libhybridgv-dev in build/deb
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh build packages
cmake -S . -B build/deb -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr \
  -DHYBRIDGV_BUILD_TESTS=OFF -DHYBRIDGV_BUILD_BENCHMARKS=OFF -DHYBRIDGV_BUILD_EXAMPLES=OFF
cmake --build build/deb -j "$(nproc)"
cd build/deb
rm -f libhybridgv*.deb
cpack -G DEB
