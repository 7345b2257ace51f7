// The error of 2D-3D correspondences in an image with radial distortion: e = distort(f (x/z, y/z)) - (u, v).
#pragma once

#include "robust/kernels/Reprojection.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// A point whose pinhole image (U, V) has 4 c (U^2 + V^2) >= 1 is seen nowhere, like one behind the camera.
struct RadialReprojection : Reprojection {
  RadialReprojection(const PointArrays& points, std::size_t i, const RadialPose& pose) : Reprojection(points, i, pose) {
    distort(points, i, pose);
  }
  void project(const PointArrays& points, std::size_t i, const RadialPose& pose) {
    Reprojection::project(points, i, pose);
    distort(points, i, pose);
  }

  Doubles pinholeU, pinholeV;

 private:
  void distort(const PointArrays& points, std::size_t i, const RadialPose& pose) {
    pinholeU = projectedU;
    pinholeV = projectedV;
    const Doubles radicand = 1.0 - 4 * pose.distortion * (pinholeU * pinholeU + pinholeV * pinholeV);
    inFront = inFront & (radicand > 0);
    const Doubles stretch = 2 / (1.0 + squareRoot(radicand));
    projectedU = stretch * pinholeU;
    projectedV = stretch * pinholeV;
    compare(points, i);
  }
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
