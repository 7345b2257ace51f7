// Functions that exist once per instruction set, and the choice among them at run time.
//
// A family of such functions is a table (or a function pointer), defined by one header in namespace HYBRIDGV_INSTRUCTION_SET. The
// build compiles that header once per instruction set (src/cmake/DispatchedKernels.cmake). Who calls them declares the versions
// by HYBRIDGV_VERSIONS and picks one by choose().
#pragma once

#include "math/simd/SimdLevel.hpp"

// Declares baseline::name, avx2::name and avx512::name in the namespace where it stands. For processors without such instruction
// sets there is one version, and all three names are names of it.
#if defined(__x86_64__)
#define HYBRIDGV_VERSIONS(type, name) \
  namespace baseline {                \
  extern const type name;             \
  }                                   \
  namespace avx2 {                    \
  extern const type name;             \
  }                                   \
  namespace avx512 {                  \
  extern const type name;             \
  }
#else
#define HYBRIDGV_VERSIONS(type, name) \
  namespace baseline {                \
  extern const type name;             \
  }                                   \
  namespace avx2 {                    \
  using baseline::name;               \
  }                                   \
  namespace avx512 {                  \
  using baseline::name;               \
  }
#endif

namespace hybridgv {
namespace math {

// The version for a level, which must not exceed supportedSimdLevel().
template <class Version>
const Version& choose(SimdLevel level, const Version& baseline, const Version& avx2, const Version& avx512) {
  switch (level) {
    case SimdLevel::Baseline:
      return baseline;
    case SimdLevel::Avx2:
      return avx2;
    case SimdLevel::Avx512:
      return avx512;
  }
  return baseline;
}

}  // namespace math
}  // namespace hybridgv
