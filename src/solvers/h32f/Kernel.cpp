#include "solvers/h32f/Kernel.hpp"

#include "math/simd/versions.hpp"

namespace hybridgv {
namespace solvers {
namespace h32f {

HYBRIDGV_VERSIONS(Kernel, kKernel)

const Kernel& kernel(math::SimdLevel level) { return math::choose(level, baseline::kKernel, avx2::kKernel, avx512::kKernel); }

const Kernel& kernel() { return kernel(math::simdLevel()); }

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv
