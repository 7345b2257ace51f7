#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

const Kernels& kernels(math::SimdLevel level) {
#if defined(HYBRIDGV_X86_KERNELS)
  if (level == math::SimdLevel::Avx512) return kKernelsAvx512;
  if (level == math::SimdLevel::Avx2) return kKernelsAvx2;
#endif
  return kKernelsSse2;
}

const Kernels& kernels() { return kernels(math::simdLevel()); }

}  // namespace robust
}  // namespace hybridgv
