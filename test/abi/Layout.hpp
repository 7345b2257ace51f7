// Size and alignment of every type that crosses the library's border, as one compilation sees them.
#pragma once

#include <cstddef>

namespace hybridgv {
namespace test {

struct LayoutEntry {
  const char* type;
  std::size_t size, alignment;
};

struct Layout {
  const LayoutEntry* entries;
  std::size_t count;
};

// One for every instruction set that CMakeLists.txt compiles Layout.cpp for.
extern const Layout layoutGeneric, layoutNoVectorization, layoutAvx2, layoutAvx512;

}  // namespace test
}  // namespace hybridgv
