// Which of a kernel's run-time dispatched versions to use.
#pragma once

namespace hybridgv {
namespace math {

enum class SimdLevel {
  Baseline,  // what every processor of the architecture has: SSE2 on x86-64, NEON on AArch64
  Avx2,      // AVX2 and FMA
  Avx512,    // AVX-512 F, DQ and VL
};

// The best level that this processor and its operating system support.
SimdLevel supportedSimdLevel();

// supportedSimdLevel(), or less if the environment variable HYBRIDGV_SIMD asks for less: baseline (or sse2, its name in version
// 0.1), avx2 or avx512; empty is as if it were not set. Read once. Throws std::invalid_argument if it is something else, in every
// call.
SimdLevel simdLevel();

// The name that HYBRIDGV_SIMD takes.
const char* toString(SimdLevel level);

}  // namespace math
}  // namespace hybridgv
