// Runs a minimal solver, through its public function, on arbitrary doubles, and stops the program if it breaks a promise:
// std::invalid_argument for data that are not finite, otherwise at most so many poses, each of which is one and satisfies the
// equations up to rounding.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "SampleBytes.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace fuzz {

// Hands the doubles on without looking at them.
class RawAdapter : public hybrid_pose::HybridAdapterBase {
 public:
  explicit RawAdapter(const Sample& sample) : sample_(sample) {}
  std::size_t getNumberCorrespondences2d2d() const override { return sample_.rays.size(); }
  Eigen::Vector3d getImagePoint2d2d(std::size_t i) const override { return {sample_.rays[i].u, sample_.rays[i].v, 1}; }
  Eigen::Vector3d getBearingVector(std::size_t i) const override { return sample_.rays[i].direction; }
  int getCamIndex(std::size_t i) const override { return sample_.rays[i].camera; }
  Eigen::Vector3d getCamOffset(std::size_t i) const override { return sample_.rays[i].centre; }
  Eigen::Matrix3d getCamRotation(std::size_t) const override { return Eigen::Matrix3d::Identity(); }
  std::size_t getNumberCorrespondences2d3d() const override { return sample_.points.size(); }
  Eigen::Vector3d getImagePoint2d3d(std::size_t i) const override { return {sample_.points[i].u, sample_.points[i].v, 1}; }
  Eigen::Vector3d getPoint(std::size_t i) const override { return sample_.points[i].point; }

 private:
  const Sample& sample_;
};

[[noreturn]] inline void reportFault(const char* promise) {
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

inline bool isFinite(const Sample& sample) {
  const auto rayIsFinite = [](const solvers::RayMatch& ray) {
    return std::isfinite(ray.u) && std::isfinite(ray.v) && ray.centre.allFinite() && ray.direction.allFinite();
  };
  const auto pointIsFinite = [](const solvers::PointMatch& match) {
    return std::isfinite(match.u) && std::isfinite(match.v) && match.point.allFinite();
  };
  return std::all_of(sample.rays.begin(), sample.rays.end(), rayIsFinite) &&
         std::all_of(sample.points.begin(), sample.points.end(), pointIsFinite);
}

class EquationCheck {
 public:
  // `exactCoordinates`: how many image coordinates of the points, counted from the first, the solver satisfies exactly.
  EquationCheck(const Sample& sample, std::size_t exactCoordinates) : sample_(sample), exactCoordinates_(exactCoordinates) {
    for (const solvers::RayMatch& ray : sample.rays) {
      imageScale_ = std::max({imageScale_, std::abs(ray.u), std::abs(ray.v)});
      extent_ = std::max(extent_, ray.centre.norm());
    }
    for (const solvers::PointMatch& match : sample.points) {
      imageScale_ = std::max({imageScale_, std::abs(match.u), std::abs(match.v)});
      extent_ = std::max(extent_, match.point.norm());
    }
  }

  void check(const FocalPose& pose) const {
    if (!pose.rotation.allFinite() || !pose.position.allFinite() || !std::isfinite(pose.focalLength))
      reportError("poses are finite", pose, 0, 0);
    if (!(pose.focalLength > 0)) reportError("focal lengths are positive", pose, 0, 0);
    if (!((pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).norm() < 1e-6) ||
        !(pose.rotation.determinant() > 0))
      reportFault("rotations are rotations");
    for (const solvers::RayMatch& ray : sample_.rays) checkRay(pose, ray);
    for (std::size_t i = 0; i < sample_.points.size(); ++i) checkPoint(pose, i);
  }

 private:
  [[noreturn]] static void reportError(const char* promise, const FocalPose& pose, double error, double allowed) {
    std::fprintf(stderr, "error %g, allowed %g; focal length %g, position %g %g %g\n", error, allowed, pose.focalLength,
                 pose.position[0], pose.position[1], pose.position[2]);
    reportFault(promise);
  }

  static constexpr double kTolerance = 1e-6;  // of the largest image coordinate

  // How many pixels rounding errors in the unit of the whole scene make at an image point (u, v), `distance` away from the query.
  double rounding(const FocalPose& pose, double u, double v, double distance) const {
    constexpr double kOperations = 1e5;
    const double f = pose.focalLength, size = extent_ + pose.position.norm() + distance;
    return kOperations * std::numeric_limits<double>::epsilon() * (f + (u * u + v * v) / f) * size / distance;
  }

  // Almost perpendicular to the optical axis, where the smallest errors become large.
  static bool isGrazing(const FocalPose& pose, double u, double v) { return std::hypot(u, v) > 1e3 * pose.focalLength; }

  // Written so that what overflows passes.
  void checkPoint(const FocalPose& pose, std::size_t i) const {
    const solvers::PointMatch& match = sample_.points[i];
    const Eigen::Vector3d x = pose.rotation.transpose() * (match.point - pose.position);
    const double allowed = kTolerance * imageScale_ + rounding(pose, match.u, match.v, x.norm());
    if (!(allowed < imageScale_) || isGrazing(pose, match.u, match.v)) return;
    if (x[2] <= 0) reportError("points are in front of the query", pose, -x[2], 0);
    const double errorU = std::abs(pose.focalLength * x[0] / x[2] - match.u);
    const double errorV = std::abs(pose.focalLength * x[1] / x[2] - match.v);
    if (2 * i < exactCoordinates_ && errorU > allowed) reportError("the u coordinates of points are met", pose, errorU, allowed);
    if (2 * i + 1 < exactCoordinates_ && errorV > allowed)
      reportError("the v coordinates of points are met", pose, errorV, allowed);
  }

  // Distance of the image point from the image of the ray.
  void checkRay(const FocalPose& pose, const solvers::RayMatch& ray) const {
    const Eigen::Vector3d b = pose.rotation.transpose() * (ray.centre - pose.position);
    const Eigen::Vector3d a = pose.rotation.transpose() * ray.direction.normalized();
    Eigen::Vector3d line = b.cross(a);
    // The line of sight and the ray nearly coincide with the baseline: no line.
    if (!(line.norm() > 1e-6 * b.norm())) return;
    line[2] *= pose.focalLength;
    const double allowed = kTolerance * imageScale_ + rounding(pose, ray.u, ray.v, line.norm());
    if (!(allowed < imageScale_) || isGrazing(pose, ray.u, ray.v)) return;
    if (std::abs(line.dot(Eigen::Vector3d(ray.u, ray.v, 1))) > allowed * line.head<2>().norm()) reportFault("rays are met");
  }

  const Sample& sample_;
  std::size_t exactCoordinates_;
  double imageScale_ = 0;  // largest image coordinate
  double extent_ = 0;      // largest distance of a point or centre from the origin
};

template <class Solve>
int fuzzSolver(const std::uint8_t* data, std::size_t size, std::size_t rays, std::size_t points, std::size_t maxSolutions,
               std::size_t exactCoordinates, Solve solve) {
  const Sample sample = decodeSample(data, size, rays, points);
  const RawAdapter adapter(sample);
  FocalPoses poses;
  try {
    poses = solve(adapter);
  } catch (const std::invalid_argument&) {
    // Also for a ray without direction, and for rays of several cameras where one is demanded.
    return 0;
  }
  if (!isFinite(sample)) reportFault("data that are not finite are refused");
  if (poses.size() > maxSolutions) reportFault("there are not more solutions than the problem has");
  const EquationCheck equations(sample, exactCoordinates);
  for (const FocalPose& pose : poses) equations.check(pose);
  return 0;
}

}  // namespace fuzz
}  // namespace hybridgv
