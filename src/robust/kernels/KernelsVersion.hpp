// The kernels for the instruction set of the including file, see math/simd/versions.hpp.
#pragma once

#include "robust/kernels/Leverages.hpp"
#include "robust/kernels/PointEquations.hpp"
#include "robust/kernels/RayEquations.hpp"
#include "robust/kernels/Scores.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

extern const Kernels kKernels;
const Kernels kKernels = {&squaredPointErrors, &squaredRayErrors, &scorePoints, &scoreRays, &addPoints, &addRays, &rayLeverages};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
