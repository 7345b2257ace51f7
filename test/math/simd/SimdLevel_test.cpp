#include "math/simd/SimdLevel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "HybridScene.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/instructionSet.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace {

using math::simdLevel;
using math::SimdLevel;
using math::supportedSimdLevel;

// The environment is read once, so each case runs in a process of its own: a copy of this one, which must not read it.
template <class Condition>
void expectWith(const char* requested, Condition condition) {
  EXPECT_EXIT(
      {
        setenv("HYBRIDGV_SIMD", requested, 1);
        std::exit(condition() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "")
      << requested;
}

void expectLevel(const char* requested, SimdLevel expected) {
  expectWith(requested, [expected] { return simdLevel() == expected; });
}

TEST(SimdLevel, EnvironmentVariableLowersTheLevelButNeverRaisesIt) {
  expectLevel("baseline", SimdLevel::Baseline);
  expectLevel("sse2", SimdLevel::Baseline);
  expectLevel("avx2", std::min(SimdLevel::Avx2, supportedSimdLevel()));
  expectLevel("avx512", supportedSimdLevel());
  expectLevel("", supportedSimdLevel());
}

TEST(SimdLevel, InstructionSetNamesTheLevel) {
  expectWith("baseline", [] { return instructionSet() == std::string("baseline"); });
  expectWith("sse2", [] { return instructionSet() == std::string("baseline"); });
  expectWith("", [] { return instructionSet() == std::string(toString(simdLevel())); });
}

// Whether the call is refused by an error that names the variable, its value and what it may be; twice, as the value stays wrong.
template <class Call>
bool isRefused(const std::string& value, Call call) {
  int refusals = 0;
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      call();
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      refusals += message == "hybridgv: environment variable HYBRIDGV_SIMD: must be baseline (or sse2), avx2 or avx512, is \"" +
                                 value + "\"";
    }
  }
  return refusals == 2;
}

TEST(SimdLevel, AnUnknownNameIsRefused) {
  for (const char* value : {"AVX2", "neon", "something else", " avx2", "avx"})
    expectWith(value, [value] { return isRefused(value, [] { simdLevel(); }); });
}

// The error comes in the caller's thread, not in a worker.
TEST(SimdLevel, AnUnknownNameIsRefusedByThePublicFunctions) {
  test::Random random(test::testSeed());
  const test::HybridScene scene = test::makeHybridScene(random, {});
  const NoncentralHybridAdapter adapter = scene.adapter();
  sac::HybridRansacOptions options;
  options.threads = 4;
  const FocalPose pose = scene.truth;
  expectWith("AVX2", [&] {
    return isRefused("AVX2", [&] { hybrid_pose::h32f(adapter); }) && isRefused("AVX2", [&] { hybrid_pose::h51f(adapter); }) &&
           isRefused("AVX2", [&] { hybrid_pose::optimize_nonlinear(adapter, pose); }) &&
           isRefused("AVX2", [&] { sac::hybridRansac(adapter, options); });
  });
}

TEST(SimdLevel, NamesAreThoseOfTheEnvironmentVariable) {
  EXPECT_EQ(std::string("baseline"), toString(SimdLevel::Baseline));
  EXPECT_EQ(std::string("avx2"), toString(SimdLevel::Avx2));
  EXPECT_EQ(std::string("avx512"), toString(SimdLevel::Avx512));
}

}  // namespace
}  // namespace hybridgv
