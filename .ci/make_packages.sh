#!/bin/sh
# Installs what is missing, builds the libraries, the program and the Python module alone, and leaves the Debian packages libhybridgv0.1,
# libhybridgv-colmap0.1, libhybridgv-dev, hybridgv and python3-hybridgv in build/deb
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh build packages program python
cmake -S . -B build/deb -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr \
  -DHYBRIDGV_BUILD_TESTS=OFF -DHYBRIDGV_BUILD_BENCHMARKS=OFF -DHYBRIDGV_BUILD_EXAMPLES=OFF
cmake --build build/deb -j "$(nproc)"
cd build/deb
rm -f libhybridgv*.deb hybridgv*.deb python3-hybridgv*.deb
cpack -G DEB
