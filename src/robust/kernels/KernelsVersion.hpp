// The kernels for the instruction set of the including file, see math/simd/versions.hpp.
#pragma once

#include "robust/kernels/Leverages.hpp"
#include "robust/kernels/Pinhole.hpp"
#include "robust/kernels/PointEquations.hpp"
#include "robust/kernels/Radial.hpp"
#include "robust/kernels/RayEquations.hpp"
#include "robust/kernels/Rows.hpp"
#include "robust/kernels/Scores.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

template <class Camera>
constexpr Kernels makeKernels() {
  return {&squaredPointErrors<Camera>,
          &squaredRayErrors<Camera, false>,
          &squaredRayErrors<Camera, true>,
          &scorePoints<Camera>,
          &scoreRays<Camera>,
          &addPoints<Camera>,
          &addRays<Camera>,
          &addPointShifts<Camera>,
          &addRayShifts<Camera>,
          &rayLeverages<Camera>,
          &rayRows,
          &pointRows,
          &countLevels};
}

extern const Kernels kPinholeKernels, kCalibratedPinholeKernels, kRadialKernels;
const Kernels kPinholeKernels = makeKernels<Pinhole>();
const Kernels kCalibratedPinholeKernels = makeKernels<CalibratedPinhole>();
const Kernels kRadialKernels = makeKernels<Radial>();

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
