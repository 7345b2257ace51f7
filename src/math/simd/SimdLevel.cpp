#include "math/simd/SimdLevel.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace hybridgv {
namespace math {

SimdLevel supportedSimdLevel() {
#if (defined(__GNUC__) || defined(__clang__)) && defined(__x86_64__)
  __builtin_cpu_init();  // the built-in test includes whether the operating system saves the wide registers
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return SimdLevel::Sse2;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") || !__builtin_cpu_supports("avx512vl"))
    return SimdLevel::Avx2;
  return SimdLevel::Avx512;
#else
  return SimdLevel::Sse2;
#endif
}

const char* toString(SimdLevel level) {
  switch (level) {
    case SimdLevel::Sse2:
      return "sse2";
    case SimdLevel::Avx2:
      return "avx2";
    case SimdLevel::Avx512:
      return "avx512";
  }
  return "sse2";
}

static SimdLevel requestedSimdLevel() {
  const char* name = std::getenv("HYBRIDGV_SIMD");  // NOLINT(concurrency-mt-unsafe): read once, never set
  for (const SimdLevel level : {SimdLevel::Sse2, SimdLevel::Avx2, SimdLevel::Avx512})
    if (name && std::strcmp(name, toString(level)) == 0) return level;
  return SimdLevel::Avx512;
}

SimdLevel simdLevel() {
  static const SimdLevel level = std::min(supportedSimdLevel(), requestedSimdLevel());
  return level;
}

}  // namespace math
}  // namespace hybridgv
