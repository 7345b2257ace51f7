// The error of 2D-2D correspondences that meet behind both cameras.
#pragma once

#include "robust/kernels/RadialEpipolar.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// A ray to something so far away that its disparity is as small as the noise meets its viewing ray beyond infinity as often as not: behind both
// cameras. If that were no inlier, the pose would give way until it is one. So it has a second error, how far its image point x is from q, that
// of its point at infinity, along the epipolar line:
//
//     d = t . (q - x),   q = f (D_x, D_y) / D_z,   t = (-l2, l1) / |(l1, l2)|,
//
// D the ray's direction in the query's frame, l1 and l2 as in Epipolar. q moves with the direction in the map's image, so that the variance of d
// is that of x times 1 + h f^2 / D_z^2. At infinity d is 0: the cost and its derivatives are continuous. x is in a pinhole image.
struct BeyondInfinity {
  // `depth`: of the viewing direction (u, v, depth), f in a pinhole image.
  BeyondInfinity(const Epipolar& ray, const Pose& pose) {
    const Vec3<Doubles> direction = pose.toQuery(ray.direction);
    const Doubles perDepth = 1 / direction.z, stretch = pose.f / ray.image.z,
                  perLength = 1 / squareRoot(ray.l1 * ray.l1 + ray.l2 * ray.l2);
    mx = direction.x * perDepth;
    my = direction.y * perDepth;
    tx = -ray.l2 * perLength;
    ty = ray.l1 * perLength;
    x = stretch * ray.image.x;
    y = stretch * ray.image.y;
    error = tx * (pose.f * mx - x) + ty * (pose.f * my - y);
    const Doubles perMapPixel = pose.f * perDepth;
    precision = 1 / (1.0 + ray.squaredPixel * perMapPixel * perMapPixel);
    // Behind both cameras, while there is something at infinity before the query.
    applies = (dot(ray.l, ray.s) < 0) & (dot(ray.n, ray.s) > 0) & (direction.z > 0) & (ray.image.z > 0) & (squared() < kInfinity);
  }
  Doubles squared() const { return precision * error * error; }

  Doubles mx, my, tx, ty, x, y;
  Doubles error, precision;  // d, and the inverse of its relative variance
  DoubleMask applies;
};

// With m = (D_x, D_y) / D_z and q = f m:
//   dq_u = (q_u m_y, -f - q_u m_x, q_v) . rotation + q_u dlogf
//   dq_v = (f + q_v m_y, -q_v m_x, -q_u) . rotation + q_v dlogf
// t changes in proportion to d and is kept. Where it does not apply, the derivatives are 0.
template <int N>
HYBRIDGV_INLINE void differentiate(const BeyondInfinity& ray, const Pose& pose, Row<N>& derivatives) {
  const Doubles qu = pose.f * ray.mx, qv = pose.f * ray.my, along = ray.tx * qu + ray.ty * qv;
  derivatives[0] = along * ray.my + ray.ty * pose.f;
  derivatives[1] = -along * ray.mx - ray.tx * pose.f;
  derivatives[2] = ray.tx * qv - ray.ty * qu;
  derivatives[3] = derivatives[4] = derivatives[5] = Doubles{};
  if constexpr (N > correspondences::kPoseParameters) derivatives[6] = along;
  for (int k = 0; k < N; ++k) derivatives[k] = select<Doubles>(ray.applies, derivatives[k], Doubles{});
}

HYBRIDGV_INLINE void differentiate(const BeyondInfinity& beyond, const Epipolar&, const Pose& pose,
                                   Row<correspondences::kPoseParameters>& derivatives) {
  differentiate(beyond, pose, derivatives);
}
HYBRIDGV_INLINE void differentiate(const BeyondInfinity& beyond, const Epipolar&, const Pose& pose,
                                   Row<correspondences::kFocalPoseParameters>& derivatives) {
  differentiate(beyond, pose, derivatives);
}
// x is (u, v) / (1 + c r^2), its derivative by c -x r^2 / (1 + c r^2).
HYBRIDGV_INLINE void differentiate(const BeyondInfinity& beyond, const RadialEpipolar& ray, const RadialPose& pose,
                                   Row<kMostParameters>& derivatives) {
  derivatives[7] = Doubles{};
  differentiate(beyond, pose, derivatives);
  const Doubles byDistortion = (beyond.tx * beyond.x + beyond.ty * beyond.y) * ray.squaredRadius * (pose.f / ray.image.z);
  derivatives[7] = select<Doubles>(beyond.applies, byDistortion, Doubles{});
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
