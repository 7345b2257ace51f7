#!/bin/sh
# The library, its adapters and their tests with clang++ and libc++, the standard library of macOS, FreeBSD and Android: all but the
# parts that link libopengv, which Debian builds with another one.
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh build clang libcxx
build=build/libcxx
jobs=$(nproc)
libcxx="-G Ninja -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_CXX_FLAGS=-stdlib=libc++ -DCMAKE_BUILD_TYPE=Release"

cmake -S /usr/src/googletest -B $build/googletest $libcxx -DCMAKE_INSTALL_PREFIX="$PWD/$build/prefix" -DBUILD_GMOCK=OFF
cmake --build $build/googletest -j "$jobs" --target install

cmake -S . -B $build $libcxx -DHYBRIDGV_WERROR=ON -DHYBRIDGV_BUILD_BENCHMARKS=OFF -DHYBRIDGV_BUILD_EXAMPLES=OFF \
  -DCMAKE_DISABLE_FIND_PACKAGE_opengv=ON -DGTest_DIR="$PWD/$build/prefix/lib/cmake/GTest"
cmake --build $build -j "$jobs"
ctest --test-dir $build -j "$jobs" --output-on-failure
