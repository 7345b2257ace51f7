// The normal equations of 2D-3D correspondences, for any camera model (Pinhole.hpp).
#pragma once

#include "robust/kernels/Losses.hpp"
#include "robust/kernels/Ranges.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

template <class Camera>
static void addPoints(const PointArrays& points, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (points.size == 0) return;
  const typename Camera::Pose pose(plainPose);
  const Doubles inverseFocal = broadcast<Doubles>(1 / plainPose.focalLength);
  CostSum cost(loss);
  typename Camera::PointSums sums;
  forRangeOfLongBody(0, points.size, [&](std::size_t i, DoubleMask inRange) {
    typename Camera::Point point(points, i, pose);
    const DoubleMask valid = point.inFront & (point.squaredError < kInfinity);
    const Doubles weight = cost.weigh(inRange, valid, point.squaredError);
    if (!any(weight > 0)) return;
    if (any(~valid)) {  // where there is no projection, any finite one will do
      Vec3<Doubles>& y = point.inQuery;
      y = {select<Doubles>(valid, y.x, Doubles{}), select<Doubles>(valid, y.y, Doubles{}),
           select<Doubles>(valid, y.z, broadcast<Doubles>(1))};
      point.project(points, i, pose);
    }
    sums.add(point, inverseFocal, pose, weight);
  });
  total.cost += cost.total();
  sums.addTo(plainPose, total);
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
