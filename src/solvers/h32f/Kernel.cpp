#include "solvers/h32f/Kernel.hpp"

namespace hybridgv {

namespace baseline {
extern const solvers::hidden_variable::Kernel kH32fKernel;
}
namespace avx2 {
extern const solvers::hidden_variable::Kernel kH32fKernel;
}
namespace avx512 {
extern const solvers::hidden_variable::Kernel kH32fKernel;
}

namespace solvers {
namespace hidden_variable {

const Kernel& kernel(math::SimdLevel level) {
  switch (level) {
    case math::SimdLevel::Avx512:
      return avx512::kH32fKernel;
    case math::SimdLevel::Avx2:
      return avx2::kH32fKernel;
    case math::SimdLevel::Sse2:
      break;
  }
  return baseline::kH32fKernel;
}

const Kernel& kernel() {
  static const Kernel& best = kernel(math::simdLevel());
  return best;
}

}  // namespace hidden_variable
}  // namespace solvers
}  // namespace hybridgv
