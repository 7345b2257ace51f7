// Whether a pose is one and satisfies the equations of a minimal sample, for data of any size: up to rounding errors in the unit
// of the whole scene. Where these are as large as the image, nothing is checked.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "hybridgv/types.hpp"
#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace test {

class EquationCheck {
 public:
  // `exactCoordinates`: how many image coordinates of the points, counted from the first, the solver satisfies exactly.
  EquationCheck(const std::vector<solvers::RayMatch>& rays, const std::vector<solvers::PointMatch>& points,
                std::size_t exactCoordinates)
      : rays_(rays), points_(points), exactCoordinates_(exactCoordinates) {
    for (const solvers::RayMatch& ray : rays) {
      imageScale_ = std::max({imageScale_, std::abs(ray.u), std::abs(ray.v)});
      extent_ = std::max(extent_, ray.centre.norm());
    }
    for (const solvers::PointMatch& match : points) {
      imageScale_ = std::max({imageScale_, std::abs(match.u), std::abs(match.v)});
      extent_ = std::max(extent_, match.point.norm());
    }
  }

  // The promise that the pose breaks; empty if it keeps them all.
  std::string violation(const FocalPose& pose) const {
    if (!pose.rotation.allFinite() || !pose.position.allFinite() || !std::isfinite(pose.focalLength))
      return describe("poses are finite", pose, 0, 0);
    if (!(pose.focalLength > 0)) return describe("focal lengths are positive", pose, 0, 0);
    if (!((pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).norm() < 1e-6) ||
        !(pose.rotation.determinant() > 0))
      return "rotations are rotations";
    std::string result;
    for (std::size_t i = 0; i < rays_.size() && result.empty(); ++i) result = rayViolation(pose, rays_[i]);
    for (std::size_t i = 0; i < points_.size() && result.empty(); ++i) result = pointViolation(pose, i);
    return result;
  }

 private:
  static std::string describe(const char* promise, const FocalPose& pose, double error, double allowed) {
    char text[300];
    std::snprintf(text, sizeof text, "%s: error %g, allowed %g; focal length %g, position %g %g %g", promise, error, allowed,
                  pose.focalLength, pose.position[0], pose.position[1], pose.position[2]);
    return text;
  }

  static constexpr double kTolerance = 1e-6;  // of the largest image coordinate
  static constexpr double kOperations = 100;  // of which each may round

  // How many pixels rounding errors in the unit of the whole scene make at an image point (u, v), `distance` away from the query.
  double rounding(const FocalPose& pose, double u, double v, double distance) const {
    constexpr double kOperations = 1e5;
    const double f = pose.focalLength, size = extent_ + pose.position.norm() + distance;
    return kOperations * std::numeric_limits<double>::epsilon() * (f + (u * u + v * v) / f) * size / distance;
  }

  // Almost perpendicular to the optical axis, where the smallest errors become large.
  static bool isGrazing(const FocalPose& pose, double u, double v) { return std::hypot(u, v) > 1e3 * pose.focalLength; }

  // Written so that what overflows passes.
  std::string pointViolation(const FocalPose& pose, std::size_t i) const {
    const solvers::PointMatch& match = points_[i];
    const Eigen::Vector3d x = pose.rotation.transpose() * (match.point - pose.position);
    const double projectedU = pose.focalLength * x[0] / x[2], projectedV = pose.focalLength * x[1] / x[2];
    const bool isExactU = 2 * i < exactCoordinates_, isExactV = 2 * i + 1 < exactCoordinates_;
    // A coordinate that the solver need not meet can be anywhere.
    const double u = isExactU ? match.u : projectedU, v = isExactV ? match.v : projectedV;
    const double allowed = kTolerance * imageScale_ + rounding(pose, u, v, x.norm());
    if (!(allowed < imageScale_) || isGrazing(pose, u, v)) return "";
    // Where the query stands in the point, rounding decides on the sign of the depth and on the image.
    const double roundingOfDepth = kOperations * std::numeric_limits<double>::epsilon() * (extent_ + pose.position.norm());
    if (std::abs(x[2]) <= roundingOfDepth) return "";
    if (x[2] <= 0) return describe("points are in front of the query", pose, -x[2], 0);
    if (isExactU && std::abs(projectedU - u) > allowed)
      return describe("the u coordinates of points are met", pose, std::abs(projectedU - u), allowed);
    if (isExactV && std::abs(projectedV - v) > allowed)
      return describe("the v coordinates of points are met", pose, std::abs(projectedV - v), allowed);
    return "";
  }

  // Distance of the image point from the image of the ray.
  std::string rayViolation(const FocalPose& pose, const solvers::RayMatch& ray) const {
    const Eigen::Vector3d b = pose.rotation.transpose() * (ray.centre - pose.position);
    const Eigen::Vector3d a = pose.rotation.transpose() * ray.direction.normalized();
    Eigen::Vector3d line = b.cross(a);
    // The line of sight and the ray nearly coincide with the baseline: no line.
    // Of the query from the ray: an error in the position turns the plane of both by its share of that.
    const double distance = line.norm();
    if (!(distance > 1e-6 * b.norm())) return "";
    line[2] *= pose.focalLength;
    const double allowed = kTolerance * imageScale_ + rounding(pose, ray.u, ray.v, distance);
    if (!(allowed < imageScale_) || isGrazing(pose, ray.u, ray.v)) return "";
    const double error = std::abs(line.dot(Eigen::Vector3d(ray.u, ray.v, 1)));
    if (error > allowed * line.head<2>().norm()) return describe("rays are met", pose, error / line.head<2>().norm(), allowed);
    return depthViolation(pose, ray, a, b);
  }

  // The two rays b + beta a and lambda (u, v, f) meet where beta and lambda are positive. Where they are nearly parallel,
  // rounding decides on the signs.
  std::string depthViolation(const FocalPose& pose, const solvers::RayMatch& ray, const Eigen::Vector3d& a,
                             const Eigen::Vector3d& b) const {
    constexpr double kSmallAngle = 1e-3, kRounding = 1e-6;
    const Eigen::Vector3d p = Eigen::Vector3d(ray.u, ray.v, pose.focalLength).normalized(), n = p.cross(a);
    const double sine = n.norm();
    if (!(sine > kSmallAngle)) return "";
    const double beta = -p.cross(b).dot(n) / (sine * sine), lambda = -a.cross(b).dot(n) / (sine * sine);
    const double roundingOfCentres = kOperations * std::numeric_limits<double>::epsilon() * (extent_ + pose.position.norm());
    const double allowed = -(kRounding * b.norm() + roundingOfCentres) / sine;
    if (beta < allowed) return describe("rays are met on their forward side", pose, beta, allowed);
    if (lambda < allowed) return describe("rays are met in front of the query", pose, lambda, allowed);
    return "";
  }

  const std::vector<solvers::RayMatch>& rays_;
  const std::vector<solvers::PointMatch>& points_;
  std::size_t exactCoordinates_;
  double imageScale_ = 0;  // largest image coordinate
  double extent_ = 0;      // largest distance of a point or centre from the origin
};

}  // namespace test
}  // namespace hybridgv
