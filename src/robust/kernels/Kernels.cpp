#include "robust/kernels/Kernels.hpp"

#include "math/simd/versions.hpp"

namespace hybridgv {
namespace robust {

HYBRIDGV_VERSIONS(Kernels, kKernels)

const Kernels& kernels(math::SimdLevel level) {
  return math::choose(level, baseline::kKernels, avx2::kKernels, avx512::kKernels);
}

const Kernels& kernels() { return kernels(math::simdLevel()); }

}  // namespace robust
}  // namespace hybridgv
