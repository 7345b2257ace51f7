#include "math/simd/SimdLevel.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "CheckArguments.hpp"
#include "hybridgv/instructionSet.hpp"

namespace hybridgv {
namespace math {

SimdLevel supportedSimdLevel() {
#if defined(__x86_64__)
  __builtin_cpu_init();  // the built-in test includes whether the operating system saves the wide registers
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return SimdLevel::Baseline;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") || !__builtin_cpu_supports("avx512vl"))
    return SimdLevel::Avx2;
  return SimdLevel::Avx512;
#else
  return SimdLevel::Baseline;
#endif
}

const char* toString(SimdLevel level) {
  switch (level) {
    case SimdLevel::Baseline:
      return "baseline";
    case SimdLevel::Avx2:
      return "avx2";
    case SimdLevel::Avx512:
      return "avx512";
  }
  return "baseline";
}

static SimdLevel requestedSimdLevel() {
  const char* value = std::getenv("HYBRIDGV_SIMD");  // NOLINT(concurrency-mt-unsafe): read once, never set
  const std::string name = value ? value : "";
  if (name.empty()) return SimdLevel::Avx512;
  if (name == "sse2") return SimdLevel::Baseline;
  for (const SimdLevel level : {SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512})
    if (name == toString(level)) return level;
  throwInvalid("environment variable HYBRIDGV_SIMD", "must be baseline (or sse2), avx2 or avx512, is \"" + name + "\"");
}

// An exception leaves the static variable uninitialized, and the next call tries again.
SimdLevel simdLevel() {
  static const SimdLevel level = std::min(supportedSimdLevel(), requestedSimdLevel());
  return level;
}

}  // namespace math

const char* instructionSet() { return math::toString(math::simdLevel()); }

}  // namespace hybridgv
