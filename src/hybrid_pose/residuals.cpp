#include "hybridgv/hybrid_pose/residuals.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>

#include "correspondences/EpipolarRay.hpp"
#include "hybridgv/distortion.hpp"

namespace hybridgv {
namespace hybrid_pose {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

static double infiniteUnlessFinite(double error) { return std::isfinite(error) ? error : kInfinity; }

static bool isFinite(const FocalPose& pose) {
  return pose.rotation.allFinite() && pose.position.allFinite() && std::isfinite(pose.focalLength);
}

double reprojectionError(const FocalPose& pose, const Eigen::Vector3d& imagePoint, const Eigen::Vector3d& point) {
  return reprojectionError(pose, 0, imagePoint, point);
}

double reprojectionError(const FocalPose& pose, double distortion, const Eigen::Vector3d& imagePoint,
                         const Eigen::Vector3d& point) {
  if (!isFinite(pose) || !std::isfinite(distortion) || !imagePoint.allFinite() || !point.allFinite()) return kInfinity;
  const Eigen::Vector3d y = pose.rotation.transpose() * (point - pose.position);
  if (!(y[2] > 0)) return kInfinity;
  const Eigen::Vector3d projection(pose.focalLength * y[0] / y[2], pose.focalLength * y[1] / y[2], 1);
  const std::optional<Eigen::Vector3d> seen = distort(distortion, projection);
  if (!seen) return kInfinity;
  const double du = (*seen)[0] - imagePoint[0] / imagePoint[2];
  const double dv = (*seen)[1] - imagePoint[1] / imagePoint[2];
  return infiniteUnlessFinite(std::sqrt(du * du + dv * dv));
}

double sampsonError(const FocalPose& pose, const Eigen::Vector3d& imagePoint, const Eigen::Vector3d& bearingVector,
                    const Eigen::Vector3d& camOffset, const Eigen::Matrix3d& camRotation, double rigFocalLength) {
  return sampsonError(pose, 0, imagePoint, bearingVector, camOffset, camRotation, rigFocalLength);
}

double sampsonError(const FocalPose& pose, double distortion, const Eigen::Vector3d& imagePoint,
                    const Eigen::Vector3d& bearingVector, const Eigen::Vector3d& camOffset, const Eigen::Matrix3d& camRotation,
                    double rigFocalLength) {
  if (!isFinite(pose) || !std::isfinite(distortion) || !imagePoint.allFinite() || !bearingVector.allFinite() ||
      !camOffset.allFinite() || !camRotation.allFinite() || !std::isfinite(rigFocalLength))
    return kInfinity;
  const correspondences::EpipolarRay ray = correspondences::makeEpipolarRay(bearingVector, camRotation);
  const double u = imagePoint[0] / imagePoint[2], v = imagePoint[1] / imagePoint[2];
  const Eigen::Vector3d inQuery(u, v, pose.focalLength * (1 + distortion * (u * u + v * v)));
  const Eigen::Vector3d w = pose.rotation * inQuery;
  const Eigen::Vector3d t = camOffset - pose.position;
  const Eigen::Vector3d l = t.cross(ray.direction), n = w.cross(t), s = w.cross(ray.direction);
  // The lines position + alpha w and camOffset + beta D are closest at alpha = l.s / s.s, beta = -n.s / s.s.
  if (!(inQuery[2] > 0 && l.dot(s) > 0 && n.dot(s) < 0)) return kInfinity;
  const double g = rigFocalLength > 0 ? rigFocalLength : pose.focalLength;
  const double byRadius = 2 * distortion * pose.focalLength * pose.rotation.col(2).dot(l);
  const double byQuery =
      std::pow(pose.rotation.col(0).dot(l) + byRadius * u, 2) + std::pow(pose.rotation.col(1).dot(l) + byRadius * v, 2);
  const double byMap = n.squaredNorm() - std::pow(ray.imageNormal.dot(n), 2);
  return infiniteUnlessFinite(std::abs(w.dot(l)) / std::sqrt(byQuery + byMap / (g * g)));
}

}  // namespace hybrid_pose
}  // namespace hybridgv
