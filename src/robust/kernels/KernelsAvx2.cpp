#define HYBRIDGV_LANES 4
#include "robust/kernels/KernelBodies.hpp"

namespace hybridgv {
namespace robust {
const Kernels kKernelsAvx2 = kTable;
}  // namespace robust
}  // namespace hybridgv
