#!/bin/sh
# Installs what is missing (Debian packages), builds, runs all experiments and draws their pictures.
#   sh matlab_free_examples/experiments.sh [--quick] [--threads N] [--seed S]     results in build/experiments
# The full size takes some minutes; --quick some seconds. Each program explains itself: build/demo/matlab_free_examples/experiments/NAME --help
set -e
root=$(cd "$(dirname "$0")/.." && pwd)
sh "$root/.ci/install_packages.sh" build examples pictures
programs="solver_table synthetic_experiments compare_opengv rig_query localization_table unknown_distortion \
  rays_and_points known_focal_length focal_length_guess"
cmake -S "$root" -B "$root/build/demo" -G Ninja -DHYBRIDGV_BUILD_TESTS=OFF -DHYBRIDGV_BUILD_BENCHMARKS=OFF
cmake --build "$root/build/demo" --target $programs
results=$root/build/experiments
mkdir -p "$results"
for program in $programs; do
  echo "$program"
  "$root/build/demo/matlab_free_examples/experiments/$program" --output "$results" "$@"
done
sh "$root/matlab_free_examples/experiments/plot.sh" "$results"
echo "results: $results"
