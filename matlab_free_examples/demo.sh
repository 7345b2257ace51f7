#!/bin/sh
# Installs what is missing (Debian packages), builds, and localizes images of a map whose focal lengths are unknown: those of the
# built-in map, or of the model given. All arguments go to the program: sh matlab_free_examples/demo.sh --help
set -e
root=$(cd "$(dirname "$0")/.." && pwd)
sh "$root/.ci/install_packages.sh" build examples
{
  cmake -S "$root" -B "$root/build/demo" -G Ninja -DHYBRIDGV_BUILD_TESTS=OFF -DHYBRIDGV_BUILD_BENCHMARKS=OFF
  cmake --build "$root/build/demo" --target localize
} >&2  # the program's output alone goes to the standard output
exec "$root/build/demo/matlab_free_examples/localize" "$@"
