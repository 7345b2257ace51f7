#define HYBRIDGV_LANES 2
#include "robust/kernels/KernelBodies.hpp"

namespace hybridgv {
namespace robust {
const Kernels kKernelsSse2 = kTable;
}  // namespace robust
}  // namespace hybridgv
