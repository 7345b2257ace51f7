// Correspondences as the inner loops read them: one array per quantity. Plain data only, no Eigen type, because these loops are
// compiled once per instruction set.
#pragma once

#include <cstddef>

namespace hybridgv {
namespace correspondences {

// Arrays are padded to a multiple of this many entries, with entries that have an infinite error.
constexpr std::size_t kPadding = 8;

// Numbers padded like the columns, or null. Nothing but PaddedValues makes one that is not null, so that the kernels may read whole
// vectors. Always inline, for the same reason.
class PaddedPointer {
 public:
  PaddedPointer() = default;
  __attribute__((always_inline)) explicit operator bool() const { return values_ != nullptr; }
  __attribute__((always_inline)) const double* operator+(std::size_t i) const { return values_ + i; }
  // From the i-th number on, i a multiple of kPadding.
  __attribute__((always_inline)) PaddedPointer from(std::size_t i) const {
    return values_ == nullptr ? *this : PaddedPointer(values_ + i);
  }

 private:
  friend class PaddedValues;
  explicit PaddedPointer(const double* values) : values_(values) {}
  const double* values_ = nullptr;
};

// 2D-3D correspondences: image point (u, v), rig point (x, y, z).
struct PointArrays {
  std::size_t size = 0;  // without the padding
  const double *u, *v, *x, *y, *z;
};

// 2D-2D correspondences: image point (u, v), centre c of the rig camera, direction d and image normal a (EpipolarRay). The square
// of the map image's pixel is squaredPixel (1/g^2) where g is known; otherwise that is 0 and isUnknown is 1, not 0: then g is the
// query's focal length. The loss of a ray is narrower than KindLoss says by the square root of its `narrowing`, with the same
// curvature at 0; null: by 1; a ray of which it is infinite does not count.
struct RayArrays {
  std::size_t size = 0;
  const double *u, *v, *cx, *cy, *cz, *dx, *dy, *dz, *ax, *ay, *az, *squaredPixel, *isUnknown;
  PaddedPointer narrowing = {};
};

}  // namespace correspondences
}  // namespace hybridgv
