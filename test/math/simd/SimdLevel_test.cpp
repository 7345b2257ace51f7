#include "math/simd/SimdLevel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace hybridgv {
namespace {

using math::simdLevel;
using math::SimdLevel;
using math::supportedSimdLevel;

// The environment is read once, so each case runs in a process of its own.
void expectLevel(const char* requested, SimdLevel expected) {
  EXPECT_EXIT(
      {
        setenv("HYBRIDGV_SIMD", requested, 1);
        std::exit(simdLevel() == expected ? 0 : 1);
      },
      testing::ExitedWithCode(0), "")
      << requested;
}

TEST(SimdLevel, EnvironmentVariableLowersTheLevelButNeverRaisesIt) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  expectLevel("sse2", SimdLevel::Sse2);
  expectLevel("avx2", std::min(SimdLevel::Avx2, supportedSimdLevel()));
  expectLevel("avx512", supportedSimdLevel());
  expectLevel("something else", supportedSimdLevel());
}

TEST(SimdLevel, NamesAreThoseOfTheEnvironmentVariable) {
  EXPECT_EQ(std::string("sse2"), toString(SimdLevel::Sse2));
  EXPECT_EQ(std::string("avx2"), toString(SimdLevel::Avx2));
  EXPECT_EQ(std::string("avx512"), toString(SimdLevel::Avx512));
}

}  // namespace
}  // namespace hybridgv
