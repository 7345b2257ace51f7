#include "Layout.hpp"

#include <gtest/gtest.h>

namespace hybridgv {
namespace test {
namespace {

void expectEqual(const Layout& layout, const char* name) {
  ASSERT_EQ(layout.count, layoutGeneric.count) << name;
  for (std::size_t i = 0; i < layout.count; ++i) {
    EXPECT_EQ(layout.entries[i].size, layoutGeneric.entries[i].size) << layout.entries[i].type << ", " << name;
    EXPECT_EQ(layout.entries[i].alignment, layoutGeneric.entries[i].alignment) << layout.entries[i].type << ", " << name;
  }
}

TEST(Abi, LayoutDoesNotDependOnVectorization) { expectEqual(layoutNoVectorization, "EIGEN_DONT_VECTORIZE"); }

#ifdef HYBRIDGV_TEST_X86
TEST(Abi, LayoutDoesNotDependOnAvx2) { expectEqual(layoutAvx2, "-mavx2 -mfma"); }
TEST(Abi, LayoutDoesNotDependOnAvx512) { expectEqual(layoutAvx512, "-mavx512f"); }
#endif

}  // namespace
}  // namespace test
}  // namespace hybridgv
