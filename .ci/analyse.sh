#!/bin/sh
# Static analysis of the library and the adapters: clang-tidy (.clang-tidy says which checks) and cppcheck. Any finding is an error.
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh build analysis
cmake --preset tidy -G Ninja
cmake --build build/tidy -j "$(nproc)"
cppcheck --quiet --error-exitcode=1 --std=c++17 --language=c++ -j "$(nproc)" --enable=warning,performance,portability \
  --suppressions-list=.ci/cppcheck-suppressions.txt -I src -I include -I build/tidy/include -I adapters/arrays/include \
  -I adapters/sfm/include -I adapters/colmap/include src adapters
