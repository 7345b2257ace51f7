// The error of 2D-2D correspondences that meet behind both cameras.
#pragma once

#include "robust/kernels/RadialEpipolar.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// A ray to something so far away that its disparity is as small as the noise meets its viewing ray beyond infinity as often as not: behind both
// cameras. If that were no inlier, the pose would give way until it is one. So it has a second error, how far its image point x is beyond q, the
// image of its point at infinity, along the epipolar line:
//
//     d = t . (q - x),   q = f (D_x, D_y) / D_z,   t = (-l2, l1) / |(l1, l2)|,
//
// D the ray's direction in the query's frame, l1 and l2 as in Epipolar. q moves with the direction in the map's image, so that the variance of d
// is that of x times 1 + h (f a.D / D_z)^2, a the map image's normal. At infinity d is 0: the cost and its derivatives are continuous. x is in a
// pinhole image.
struct BeyondInfinity {
  BeyondInfinity(const Epipolar& ray, const Pose& pose) {
    const Vec3<Doubles> direction = pose.toQuery(ray.direction);
    const Doubles perDepth = 1 / direction.z, stretch = pose.f / ray.image.z,
                  length = squareRoot(ray.l1 * ray.l1 + ray.l2 * ray.l2);
    mx = direction.x * perDepth;
    my = direction.y * perDepth;
    tx = -ray.l2 / length;
    ty = ray.l1 / length;
    x = stretch * ray.image.x;
    y = stretch * ray.image.y;
    const Doubles distance = tx * (pose.f * mx - x) + ty * (pose.f * my - y);
    const Doubles perMapPixel = pose.f * dot(ray.imageNormal, ray.direction) * perDepth;
    error = select<Doubles>(distance > 0, distance, Doubles{});
    precision = 1 / (1.0 + ray.squaredPixel * perMapPixel * perMapPixel);
    // The inverse depth is -d D_z / (f |(l1, l2)|); its product with the depth of the map camera's centre is below 1 for what is in front of
    // both cameras or behind both.
    const DoubleMask bothOrNone = -distance * direction.z * dot(pose.r3, ray.t) < pose.f * length;
    applies = bothOrNone & (direction.z > 0) & (ray.image.z > 0) & (squared() < kInfinity);
  }
  Doubles squared() const { return precision * error * error; }

  Doubles mx, my, tx, ty, x, y;
  Doubles error, precision;  // d, 0 before infinity; the inverse of its relative variance
  DoubleMask applies;        // if the ray does not meet its viewing ray in front of both cameras
};

// With m = (D_x, D_y) / D_z and q = f m:
//   dq_u = (q_u m_y, -f - q_u m_x, q_v) . rotation + q_u dlogf
//   dq_v = (f + q_v m_y, -q_v m_x, -q_u) . rotation + q_v dlogf
// t changes in proportion to d and is kept. The relative variance p^-1 gives the error d p^(1/2) another part, so that what is summed is
//   dd - (1 - p) d ((m_y, -m_x, 0) . rotation + dlogf)
// where the last term is only there if the map image's focal length is known. Where it does not apply, the derivatives are 0.
template <int N>
HYBRIDGV_INLINE void differentiate(const BeyondInfinity& beyond, const Epipolar& ray, const Pose& pose, Row<N>& derivatives) {
  const Doubles qu = pose.f * beyond.mx, qv = pose.f * beyond.my, along = beyond.tx * qu + beyond.ty * qv;
  const Doubles byVariance = (1.0 - beyond.precision) * beyond.error;
  derivatives[0] = (along - byVariance) * beyond.my + beyond.ty * pose.f;
  derivatives[1] = (byVariance - along) * beyond.mx - beyond.tx * pose.f;
  derivatives[2] = beyond.tx * qv - beyond.ty * qu;
  derivatives[3] = derivatives[4] = derivatives[5] = Doubles{};
  if constexpr (N > correspondences::kPoseParameters)
    derivatives[6] = along - select<Doubles>(ray.squaredPixelOfQuery > 0, Doubles{}, byVariance);
  for (int k = 0; k < N; ++k) derivatives[k] = select<Doubles>(beyond.applies, derivatives[k], Doubles{});
}

// x is (u, v) / (1 + c r^2), its derivative by c -x r^2 / (1 + c r^2).
HYBRIDGV_INLINE void differentiate(const BeyondInfinity& beyond, const RadialEpipolar& ray, const RadialPose& pose,
                                   Row<kMostParameters>& derivatives) {
  derivatives[7] = Doubles{};
  differentiate<kMostParameters>(beyond, static_cast<const Epipolar&>(ray), pose, derivatives);
  const Doubles byDistortion = (beyond.tx * beyond.x + beyond.ty * beyond.y) * ray.squaredRadius * (pose.f / ray.image.z);
  derivatives[7] = select<Doubles>(beyond.applies, byDistortion, Doubles{});
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
