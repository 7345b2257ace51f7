// Which of a kernel's run-time dispatched versions to use.
#pragma once

namespace hybridgv {
namespace math {

enum class SimdLevel {
  Sse2,    // every x86-64 processor, and the plain version elsewhere
  Avx2,    // AVX2 and FMA
  Avx512,  // AVX-512 F, DQ and VL
};

// The best level that this processor and its operating system support.
SimdLevel supportedSimdLevel();

// supportedSimdLevel(), or less if the environment variable HYBRIDGV_SIMD (sse2, avx2 or avx512) asks for less; read once.
SimdLevel simdLevel();

const char* toString(SimdLevel level);

}  // namespace math
}  // namespace hybridgv
