#!/bin/sh
# The library for AArch64: cross-compiled without a warning; its kernels use the vector instructions (NEON); the tests of the solvers
# and of all kernels pass under qemu, which has the arithmetic of a real processor (but not its speed).
set -e
cd "$(dirname "$0")/.."
sh .ci/install_packages.sh build aarch64
target=aarch64-linux-gnu
emulator="qemu-aarch64 -L /usr/$target"
build=build/aarch64
jobs=$(nproc)
cross="-G Ninja -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=$target-g++ -DCMAKE_BUILD_TYPE=Release"

cmake -S /usr/src/googletest -B $build/googletest $cross -DCMAKE_C_COMPILER=$target-gcc -DCMAKE_INSTALL_PREFIX="$PWD/$build/prefix" \
  -DBUILD_GMOCK=OFF -DINSTALL_GTEST=ON
cmake --build $build/googletest -j "$jobs" --target install

cmake -S . -B $build $cross -DHYBRIDGV_WERROR=ON -DHYBRIDGV_COLMAP=OFF -DHYBRIDGV_PROGRAM=OFF -DHYBRIDGV_PYTHON=OFF -DHYBRIDGV_BUILD_BENCHMARKS=OFF -DHYBRIDGV_BUILD_EXAMPLES=OFF \
  -DCMAKE_DISABLE_FIND_PACKAGE_opengv=ON -DGTest_DIR="$PWD/$build/prefix/lib/cmake/GTest" \
  "-DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64;-L;/usr/$target"
tests="simd_level_test dixon_test binary_form_roots_test bernstein_test rational_chebyshev_test kernels_test leverage_test
  error_mixture_test pose_scorer_test chance_model_test residuals_test optimize_test known_focal_test one_centre_test three_points_test
  h32f_test h51f_test h70f_test overflow_test solver_contract_test hybrid_ransac_test"
cmake --build $build -j "$jobs" --target hybridgv $tests

# Every kernel computes with two doubles (v.2d), and H51f and H70f with four floats (v.4s), at once.
for kernel in robust/kernels/KernelsVersion solvers/h32f/KernelVersion; do
  $target-objdump -d "$(find $build/src -path "*$kernel.baseline.cpp.o")" | grep -q 'fml[as].*\.2d' || { echo "$kernel: no NEON"; exit 1; }
done
for solver in h51f h70f; do
  $target-objdump -d "$(find $build/src -path "*solvers/$solver/solvePathsVersion.baseline.cpp.o")" | grep -q 'fml[as].*\.4s'
done

# Homotopies take two hundred times as long under qemu as on a processor with wide vectors. Their own tests (h51f_test, h70f_test) run
# whole, in some twenty minutes; of the other programs' tests those that track thousands of them are left out.
long="*WrongRaysAlone*:*RaysAloneOfManyCameras*:*h51f*:*h70f_*:Situations*"
export emulator build long
printf '%s\n' $tests | xargs -I TEST -P "$jobs" sh -c '
  case TEST in h51f_test | h70f_test) filter= ;; *) filter="--gtest_filter=-$long" ;; esac
  if $emulator $build/test/TEST --gtest_brief=1 $filter >$build/TEST.log 2>&1; then echo "TEST: passed"; else cat $build/TEST.log; exit 255; fi'
