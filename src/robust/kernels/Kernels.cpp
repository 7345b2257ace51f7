#include "robust/kernels/Kernels.hpp"

#include "math/simd/versions.hpp"

namespace hybridgv {
namespace robust {

HYBRIDGV_VERSIONS(Kernels, kPinholeKernels)
HYBRIDGV_VERSIONS(Kernels, kRadialKernels)

const Kernels& kernels(math::SimdLevel level, CameraModel model) {
  return model == CameraModel::Pinhole
             ? math::choose(level, baseline::kPinholeKernels, avx2::kPinholeKernels, avx512::kPinholeKernels)
             : math::choose(level, baseline::kRadialKernels, avx2::kRadialKernels, avx512::kRadialKernels);
}

const Kernels& kernels(CameraModel model) { return kernels(math::simdLevel(), model); }

const Kernels& kernelsFor(const PlainPose& pose) {
  return kernels(pose.distortion == 0 ? CameraModel::Pinhole : CameraModel::Radial);
}

}  // namespace robust
}  // namespace hybridgv
