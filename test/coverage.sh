#!/bin/sh
# How many lines of src and adapters the tests reach; fails below 95 %. A table of the lines that are not reached lies in
# build/coverage/coverage.txt, pages with every line in build/coverage/html.
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh build tests coverage
. test/recorded_data.sh
cmake --preset coverage -G Ninja
cmake --build build/coverage -j "$(nproc)"
ctest --test-dir build/coverage -j "$(nproc)" --output-on-failure
mkdir -p build/coverage/html
gcovr --root . --object-directory build/coverage --filter src/ --filter adapters/ --exclude-throw-branches --gcov-ignore-parse-errors \
  --exclude '.*/Monodromy.*' --exclude '.*/generateStartSystems.*' \
  --txt build/coverage/coverage.txt --html-details build/coverage/html/index.html --fail-under-line 95 --print-summary
