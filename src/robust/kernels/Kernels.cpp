#include "robust/kernels/Kernels.hpp"

#include "math/simd/versions.hpp"

namespace hybridgv {
namespace robust {

HYBRIDGV_VERSIONS(Kernels, kPinholeKernels)
HYBRIDGV_VERSIONS(Kernels, kCalibratedPinholeKernels)
HYBRIDGV_VERSIONS(Kernels, kRadialKernels)

const Kernels& kernels(math::SimdLevel level, CameraModel model) {
  switch (model) {
    case CameraModel::Pinhole:
      break;
    case CameraModel::CalibratedPinhole:
      return math::choose(level, baseline::kCalibratedPinholeKernels, avx2::kCalibratedPinholeKernels,
                          avx512::kCalibratedPinholeKernels);
    case CameraModel::Radial:
      return math::choose(level, baseline::kRadialKernels, avx2::kRadialKernels, avx512::kRadialKernels);
  }
  return math::choose(level, baseline::kPinholeKernels, avx2::kPinholeKernels, avx512::kPinholeKernels);
}

const Kernels& kernels(CameraModel model) { return kernels(math::simdLevel(), model); }

const Kernels& kernelsFor(const PlainPose& pose) {
  return kernels(pose.distortion == 0 ? CameraModel::Pinhole : CameraModel::Radial);
}

}  // namespace robust
}  // namespace hybridgv
