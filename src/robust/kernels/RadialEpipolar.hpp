// The error of 2D-2D correspondences in an image with radial distortion, and its derivatives.
#pragma once

#include "robust/kernels/Epipolar.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// What is seen at (u, v) would be in the direction of (u, v, 1 + c r^2) in a pinhole image of focal length 1, so that the constraint
// C = w.l is linear in c, with w = R (u, v, f (1 + c r^2)). The error is measured where the query is observed: the derivatives of C by
// u and v are A = l1 + k u l3 and B = l2 + k v l3, k = 2 c f, L = R^T l = (l1, l2, l3), and
//
//     G = A^2 + B^2 + h (|n|^2 - (a.n)^2) .
struct RadialEpipolar : Epipolar {
  RadialEpipolar(const RayArrays& rays, std::size_t i, const RadialPose& pose, Doubles unknownPixel)
      : RadialEpipolar(rays, i, pose, unknownPixel, squaredRadiusOf(rays, i)) {}

  Doubles squaredRadius, l3, A, B, k;

 private:
  RadialEpipolar(const RayArrays& rays, std::size_t i, const RadialPose& pose, Doubles unknownPixel, Doubles r2)
      : Epipolar(rays, i, pose, unknownPixel, pose.f * (1.0 + pose.distortion * r2)), squaredRadius(r2) {
    l3 = dot(pose.r3, l);
    k = 2 * pose.distortion * pose.f;
    A = l1 + k * image.x * l3;
    B = l2 + k * image.y * l3;
    const Doubles everywhere = A * A + B * B + squaredPixel * varianceInMap;
    variance = select<Doubles>(image.z > 0, everywhere, Doubles{});  // no viewing direction: the error is infinite
  }
  static Doubles squaredRadiusOf(const RayArrays& rays, std::size_t i) {
    const Doubles u = load<Doubles>(rays.u + i), v = load<Doubles>(rays.v + i);
    return u * u + v * v;
  }
};

// Half the gradient by L of A^2 + B^2 is (A, B, E), E = k (A u + B v), in the place of (l1, l2, 0). With x = (A - l1, B - l2, E),
// the derivatives of a pinhole image whose viewing direction is w lack
//   dG/2 = (x x L) . rotation + (R x x D) . dposition + E l3 dlogf
// and have none by c:
//   dC = f r^2 l3 dc,   dG/2 = (2 f l3 (A u + B v) + h f r^2 r3 . (t x m)) dc
HYBRIDGV_INLINE void differentiate(const RadialEpipolar& ray, Doubles variance, const RadialPose& pose,
                                   Row<kMostParameters>& derivatives) {
  differentiate(static_cast<const Epipolar&>(ray), variance, pose, derivatives);
  const Doubles ratio = ray.constraint / variance, alongImage = ray.A * ray.image.x + ray.B * ray.image.y;
  const Vec3<Doubles> x{ray.k * ray.image.x * ray.l3, ray.k * ray.image.y * ray.l3, ray.k * alongImage};
  const Vec3<Doubles> byRotation = cross(x, Vec3<Doubles>{ray.l1, ray.l2, ray.l3});
  const Vec3<Doubles> byPosition = cross(pose.toRig(x), ray.direction);
  const Vec3<Doubles> m = ray.n - ray.alongNormal * ray.imageNormal;
  const Doubles mapByDepth = ray.squaredPixel * dot(pose.r3, cross(ray.t, m)), depth = pose.f * ray.squaredRadius;
  derivatives[0] -= ratio * byRotation.x;
  derivatives[1] -= ratio * byRotation.y;
  derivatives[2] -= ratio * byRotation.z;
  derivatives[3] -= ratio * byPosition.x;
  derivatives[4] -= ratio * byPosition.y;
  derivatives[5] -= ratio * byPosition.z;
  derivatives[6] -= ratio * x.z * ray.l3;
  derivatives[7] = depth * ray.l3 - ratio * (2 * pose.f * ray.l3 * alongImage + mapByDepth * depth);
}

// With dw = (r1 + k u r3) du + (r2 + k v r3) dv
//   dC = A du + B dv,   dG/2 = k l3 (A du + B dv) + h (t x m) . dw
HYBRIDGV_INLINE ImageDerivatives differentiateByImage(const RadialEpipolar& ray, Doubles variance, const RadialPose& pose) {
  const Vec3<Doubles> inMap = mapByDirection(ray);
  const Doubles ratio = ray.constraint / variance, kl3 = ray.k * ray.l3, alongAxis = ray.k * dot(inMap, pose.r3);
  return {ray.A - ratio * (kl3 * ray.A + dot(inMap, pose.r1) + ray.image.x * alongAxis),
          ray.B - ratio * (kl3 * ray.B + dot(inMap, pose.r2) + ray.image.y * alongAxis)};
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
