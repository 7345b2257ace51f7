#include "solvers/h32f/Kernel.hpp"

namespace hybridgv {

namespace sse2 {
extern const solvers::h32f::Kernel kH32fKernel;
}
#if defined(HYBRIDGV_X86_KERNELS)
namespace avx2 {
extern const solvers::h32f::Kernel kH32fKernel;
}
namespace avx512 {
extern const solvers::h32f::Kernel kH32fKernel;
}
#endif

namespace solvers {
namespace h32f {

const Kernel& kernel(math::SimdLevel level) {
#if defined(HYBRIDGV_X86_KERNELS)
  if (level == math::SimdLevel::Avx512) return avx512::kH32fKernel;
  if (level == math::SimdLevel::Avx2) return avx2::kH32fKernel;
#endif
  return sse2::kH32fKernel;
}

const Kernel& kernel() { return kernel(math::simdLevel()); }

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv
