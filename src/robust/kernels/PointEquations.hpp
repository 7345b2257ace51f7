// The normal equations of 2D-3D correspondences, for any camera model (Pinhole.hpp).
#pragma once

#include "robust/kernels/Losses.hpp"
#include "robust/kernels/Ranges.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// Calls body(i, point, weight) for all points from the i-th on, kWidth at a time, of which some have a weight.
template <class Camera, class Body>
HYBRIDGV_INLINE void forWeightedPoints(const PointArrays& points, const typename Camera::Pose& pose, CostSum& cost, Body body) {
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
    body(i, point, weight);
  });
}

template <class Camera>
static void addPoints(const PointArrays& points, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (points.size == 0) return;
  const typename Camera::Pose pose(plainPose);
  const Doubles inverseFocal = broadcast<Doubles>(1 / plainPose.focalLength);
  CostSum cost(loss);
  typename Camera::PointSums sums;
  forWeightedPoints<Camera>(points, pose, cost, [&](std::size_t, const typename Camera::Point& point, Doubles weight) {
    sums.add(point, inverseFocal, pose, weight);
  });
  total.cost += cost.total();
  sums.addTo(plainPose, total);
}

// A point's errors are what is projected minus what is seen.
template <class Camera>
static void addPointShifts(const PointArrays& points, const PlainPose& plainPose, const KindLoss& loss, ImageShiftSums& total) {
  if (points.size == 0) return;
  const typename Camera::Pose pose(plainPose);
  const Doubles inverseFocal = broadcast<Doubles>(1 / plainPose.focalLength), seen = broadcast<Doubles>(-1), unchanged{};
  CostSum cost(loss);
  typename Camera::PointSums alongU, alongV;
  forWeightedPoints<Camera>(points, pose, cost, [&](std::size_t, typename Camera::Point point, Doubles weight) {
    point.errorU = seen;
    point.errorV = unchanged;
    alongU.add(point, inverseFocal, pose, weight);
    point.errorU = unchanged;
    point.errorV = seen;
    alongV.add(point, inverseFocal, pose, weight);
  });
  NormalEquations sums[2];
  alongU.addTo(plainPose, sums[0]);
  alongV.addTo(plainPose, sums[1]);
  for (int row = 0; row < Camera::kParameters; ++row) {
    total.alongU[row] += sums[0].gradient[row];
    total.alongV[row] += sums[1].gradient[row];
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
