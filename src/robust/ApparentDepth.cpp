#include "robust/ApparentDepth.hpp"

#include <cmath>

#include "hybridgv/distortion.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::RayMatch;

// The image point of a pinhole camera; for one without a viewing direction, the last coordinate is 0.
Eigen::Vector3d pinholePoint(const RayMatch& ray, const QueryPose& pose) {
  if (pose.distortion == 0) return {ray.u, ray.v, 1};
  return undistort(pose.distortion, {ray.u, ray.v, 1});
}

// q and b times the ray's direction along the optical axis, which may be 0.
struct EpipolarLine {
  EpipolarLine(const RayMatch& ray, const QueryPose& pose) {
    const Eigen::Vector3d centre = pose.rotation.transpose() * (ray.centre - pose.position);
    const Eigen::Vector3d direction = pose.rotation.transpose() * ray.direction;
    axial = direction.z();
    q = pose.focalLength * direction.head<2>();
    b = pose.focalLength * (axial * centre.head<2>() - centre.z() * direction.head<2>());
  }
  double inverseDepthOf(const Eigen::Vector2d& imagePoint) const { return (axial * imagePoint - q).dot(b) / b.squaredNorm(); }

  double axial;
  Eigen::Vector2d q, b;
};

}  // namespace

ApparentDepth apparentDepth(const RayMatch& ray, const QueryPose& pose) {
  const EpipolarLine line(ray, pose);
  return {line.inverseDepthOf(pinholePoint(ray, pose).head<2>()), std::abs(line.axial) / line.b.norm()};
}

std::optional<ApparentPlace> apparentPlace(const RayMatch& ray, const QueryPose& pose) {
  const Eigen::Vector3d imagePoint = pinholePoint(ray, pose);
  const ApparentDepth depth = apparentDepth(ray, pose);
  const double z = 1 / depth.inverse, f = pose.focalLength;
  const Eigen::Vector3d direction = pose.rotation * Eigen::Vector3d(imagePoint.x() / f, imagePoint.y() / f, 1);
  const ApparentPlace place{pose.position + z * direction, depth.perPixel * z * z * direction};
  const bool isInFront = z > 0 && imagePoint.z() > 0 && place.position.allFinite() && place.perPixel.allFinite();
  return isInFront ? std::optional<ApparentPlace>(place) : std::nullopt;
}

std::optional<Eigen::Vector2d> movedToDepth(const RayMatch& ray, const QueryPose& pose, double inverse) {
  const EpipolarLine line(ray, pose);
  const Eigen::Vector3d imagePoint = pinholePoint(ray, pose);
  Eigen::Vector3d place = imagePoint;
  place.head<2>() += (inverse - line.inverseDepthOf(imagePoint.head<2>())) / line.axial * line.b;
  if (!(imagePoint.z() > 0) || !place.allFinite()) return std::nullopt;
  const std::optional<Eigen::Vector3d> seen = distort(pose.distortion, place);
  return seen ? std::optional<Eigen::Vector2d>(seen->head<2>()) : std::nullopt;
}

}  // namespace robust
}  // namespace hybridgv
