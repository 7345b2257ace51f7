// The error of 2D-3D correspondences: e = f (x/z, y/z) - (u, v), (x, y, z) = R^T X - R^T p.
#pragma once

#include "robust/kernels/PoseLanes.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

struct Reprojection {
  Reprojection(const PointArrays& points, std::size_t i, const Pose& pose) {
    const Vec3<Doubles> point{load<Doubles>(points.x + i), load<Doubles>(points.y + i), load<Doubles>(points.z + i)};
    inQuery = pose.toQuery(point) - pose.positionInQuery;
    inFront = inQuery.z > 0;
    project(points, i, pose);
  }
  void project(const PointArrays& points, std::size_t i, const Pose& pose) {
    scale = pose.f / inQuery.z;
    projectedU = scale * inQuery.x;
    projectedV = scale * inQuery.y;
    compare(points, i);
  }
  void compare(const PointArrays& points, std::size_t i) {
    errorU = projectedU - load<Doubles>(points.u + i);
    errorV = projectedV - load<Doubles>(points.v + i);
    squaredError = errorU * errorU + errorV * errorV;
  }

  Vec3<Doubles> inQuery;
  DoubleMask inFront;
  Doubles scale, projectedU, projectedV, errorU, errorV, squaredError;
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
