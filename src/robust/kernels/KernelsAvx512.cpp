#define HYBRIDGV_LANES 8
#include "robust/kernels/KernelBodies.hpp"

namespace hybridgv {
namespace robust {
const Kernels kKernelsAvx512 = kTable;
}  // namespace robust
}  // namespace hybridgv
