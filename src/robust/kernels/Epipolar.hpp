// The error of 2D-2D correspondences, e = C / sqrt(G), see sampsonError; and its derivatives.
#pragma once

#include "robust/kernels/PoseLanes.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

struct Epipolar {
  HYBRIDGV_INLINE Epipolar(const RayArrays& rays, std::size_t i, const Pose& pose, Doubles unknownPixel)
      : Epipolar(rays, i, pose, unknownPixel, pose.f) {}
  // `depth`: of the viewing direction (u, v, depth) in the query's frame.
  HYBRIDGV_INLINE Epipolar(const RayArrays& rays, std::size_t i, const Pose& pose, Doubles unknownPixel, Doubles depth) {
    direction = {load<Doubles>(rays.dx + i), load<Doubles>(rays.dy + i), load<Doubles>(rays.dz + i)};
    imageNormal = {load<Doubles>(rays.ax + i), load<Doubles>(rays.ay + i), load<Doubles>(rays.az + i)};
    const Vec3<Doubles> centre{load<Doubles>(rays.cx + i), load<Doubles>(rays.cy + i), load<Doubles>(rays.cz + i)};
    image = {load<Doubles>(rays.u + i), load<Doubles>(rays.v + i), depth};
    w = image.x * pose.r1 + image.y * pose.r2 + image.z * pose.r3;
    t = centre - pose.position;
    l = cross(t, direction);
    n = cross(w, t);
    s = cross(w, direction);
    squaredPixelOfQuery = load<Doubles>(rays.isUnknown + i) * unknownPixel;
    squaredPixel = load<Doubles>(rays.squaredPixel + i) + squaredPixelOfQuery;
    l1 = dot(pose.r1, l);
    l2 = dot(pose.r2, l);
    alongNormal = dot(imageNormal, n);
    constraint = dot(w, l);
    varianceInMap = dot(n, n) - alongNormal * alongNormal;
    variance = l1 * l1 + l2 * l2 + squaredPixel * varianceInMap;
  }
  // The depths alpha = l.s / s.s and beta = -n.s / s.s are positive.
  DoubleMask inFront() const { return (dot(l, s) > 0) & (dot(n, s) < 0); }
  Doubles squaredError() const { return constraint * constraint / variance; }

  Vec3<Doubles> direction, imageNormal, image, w, t, l, n, s;
  Doubles squaredPixel, squaredPixelOfQuery, l1, l2, alongNormal, varianceInMap;
  Doubles constraint, variance;  // C, G
};

// 1/g^2 of a map image with unknown focal length.
static inline double squaredPixelOfUnknown(const PlainPose& pose) { return 1 / (pose.focalLength * pose.focalLength); }

// The derivatives by N parameters.
template <int N>
using Row = Doubles[N];

// The error e = C G^(-1/2) has the derivative G^(-1/2) (dC - C/G dG/2). Summed is G (de)^2 with the weight divided by G, which
// needs no square root. With q = (u, v, f), m the part of n in the map's image plane, all vectors in the rig's frame but for the
// rotation:
//   dC   = (q x R^T l) . rotation + s . dposition + f (r3.l) dlogf
//   dG/2 = (r3.l) (l2, -l1, 0) . rotation + R^T (w x (t x m)) h . rotation
//        + ((l1 r1 + l2 r2) x D + h w x m) . dposition + (h f r3 . (t x m) - hq m.n) dlogf
// where h is the squared pixel of the map image and hq the part of it that is 1/f^2. Rows without log f end before it.
template <int N>
HYBRIDGV_INLINE void differentiate(const Epipolar& ray, Doubles variance, const Pose& pose, Row<N>& derivatives) {
  const Doubles l3 = dot(pose.r3, ray.l), h = ray.squaredPixel;
  const Vec3<Doubles> m = ray.n - ray.alongNormal * ray.imageNormal;
  const Vec3<Doubles> tm = cross(ray.t, m);
  const Vec3<Doubles> constraintByRotation = cross(ray.image, Vec3<Doubles>{ray.l1, ray.l2, l3});
  const Vec3<Doubles> mapByRotation = h * pose.toQuery(cross(ray.w, tm));
  const Vec3<Doubles> varianceByPosition = cross(ray.l1 * pose.r1 + ray.l2 * pose.r2, ray.direction) + h * cross(ray.w, m);
  const Doubles ratio = ray.constraint / variance;
  derivatives[0] = constraintByRotation.x - ratio * (l3 * ray.l2 + mapByRotation.x);
  derivatives[1] = constraintByRotation.y - ratio * (mapByRotation.y - l3 * ray.l1);
  derivatives[2] = constraintByRotation.z - ratio * mapByRotation.z;
  derivatives[3] = ray.s.x - ratio * varianceByPosition.x;
  derivatives[4] = ray.s.y - ratio * varianceByPosition.y;
  derivatives[5] = ray.s.z - ratio * varianceByPosition.z;
  if constexpr (N > correspondences::kPoseParameters) {
    const Doubles varianceByFocal = h * ray.image.z * dot(pose.r3, tm) - ray.squaredPixelOfQuery * ray.varianceInMap;
    derivatives[6] = ray.image.z * l3 - ratio * varianceByFocal;
  }
}

// The same by the place in the query's image.
struct ImageDerivatives {
  Doubles byU, byV;
};

// Half the derivative of the part of G that is measured in the map's image, by the viewing direction w: h (t x m).
HYBRIDGV_INLINE Vec3<Doubles> mapByDirection(const Epipolar& ray) {
  return ray.squaredPixel * cross(ray.t, ray.n - ray.alongNormal * ray.imageNormal);
}

//   dC = l1 du + l2 dv,   dG/2 = h (t x m) . (r1 du + r2 dv)
HYBRIDGV_INLINE ImageDerivatives differentiateByImage(const Epipolar& ray, Doubles variance, const Pose& pose) {
  const Vec3<Doubles> inMap = mapByDirection(ray);
  const Doubles ratio = ray.constraint / variance;
  return {ray.l1 - ratio * dot(inMap, pose.r1), ray.l2 - ratio * dot(inMap, pose.r2)};
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
