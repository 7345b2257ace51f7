#include "solvers/known_focal/TrianglePose.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solvers/known_focal/Bearing.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace {

// Sine of the angle at a point of a triangle that counts as collinear.
constexpr double kCollinear = 1e-12;
constexpr double kImageTolerance = 1e-7;

// Orthonormal columns: along a, in the plane of a and b, normal to it. False if these are parallel.
bool makeFrame(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Matrix3d& frame) {
  // Squares of small numbers underflow.
  const Eigen::Vector3d first = (a / a.cwiseAbs().maxCoeff()).normalized(), second = b / b.cwiseAbs().maxCoeff();
  const Eigen::Vector3d normal = first.cross(second);
  if (!(normal.norm() > kCollinear * second.norm())) return false;
  frame.col(0) = first;
  // Of vectors that are almost parallel the product is perpendicular to neither, by as much as has cancelled in it.
  frame.col(2) = (normal - first.dot(normal) * first).normalized();
  frame.col(1) = frame.col(2).cross(first);
  return true;
}

}  // namespace

bool TrianglePose::set(const PointMatch* points) {
  points_ = points;
  imageScale_ = 0;
  for (int i = 0; i < 3; ++i) {
    bearings_[i] = bearingOf(points[i].u, points[i].v);
    imageScale_ = std::max({imageScale_, std::abs(points[i].u), std::abs(points[i].v)});
  }
  Eigen::Vector3d a = points[1].point - points[0].point, b = points[2].point - points[0].point;
  const double extent = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  if (!(extent > 0) || !std::isfinite(extent)) return false;
  a /= extent;
  b /= extent;
  const double sum = a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm(), root = std::sqrt(sum);
  unit_ = extent * root;
  fromFirst_[0].setZero();
  fromFirst_[1] = a / root;
  fromFirst_[2] = b / root;
  squaredSides_[0] = a.squaredNorm() / sum;
  squaredSides_[1] = b.squaredNorm() / sum;
  squaredSides_[2] = (b - a).squaredNorm() / sum;
  return std::isfinite(unit_) && makeFrame(a, b, frame_);
}

bool TrianglePose::set(const Eigen::Vector3d& depths, FocalPose& pose) const {
  const Eigen::Vector3d first = depths[0] * bearings_[0];
  Eigen::Matrix3d seen;
  if (!makeFrame(depths[1] * bearings_[1] - first, depths[2] * bearings_[2] - first, seen)) return false;
  pose.rotation.noalias() = frame_ * seen.transpose();
  if (!isMet(pose.rotation.transpose(), first)) return false;
  pose.position = points_[0].point - unit_ * (pose.rotation * first);
  pose.focalLength = 1;
  return true;
}

bool TrianglePose::isMet(const Eigen::Matrix3d& toCamera, const Eigen::Vector3d& first) const {
  for (int i = 1; i < 3; ++i) {
    const Eigen::Vector3d y = toCamera * fromFirst_[i] + first;
    const double allowed = kImageTolerance * imageScale_ * y[2];
    if (!(std::abs(y[0] - points_[i].u * y[2]) <= allowed && std::abs(y[1] - points_[i].v * y[2]) <= allowed)) return false;
  }
  return true;
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv
