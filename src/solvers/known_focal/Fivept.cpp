// What five points give: a relative pose up to scale, and with a point or a ray of another camera an absolute one.
#include <Eigen/Geometry>
#include <algorithm>

#include "solvers/MinimalProblems.hpp"
#include "solvers/known_focal/Bearing.hpp"
#include "solvers/known_focal/FivePoints.hpp"
#include "solvers/known_focal/RayInFront.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace {

using Eigen::Vector3d;

// The centre lies at distance * t from the query.
FocalPose poseOf(const FivePoints::Motion& motion, const Vector3d& centre, double distance) {
  FocalPose pose;
  pose.rotation = motion.R.transpose();
  pose.position = centre - distance * (pose.rotation * motion.t);
  pose.focalLength = 1;
  return pose;
}

// Which of six rays has a camera of its own.
int oddOne(const RayMatch* rays) {
  const auto isAlone = [rays](const RayMatch& ray) {
    return std::count_if(rays, rays + 6, [&](const RayMatch& other) { return other.camera == ray.camera; }) == 1;
  };
  return static_cast<int>(std::find_if(rays, rays + 6, isAlone) - rays) % 6;
}

}  // namespace

int fivept(const RayMatch* rays, const PointMatch*, FocalPose* solutions) {
  int count = 0;
  for (const FivePoints::Motion& motion : FivePoints(rays)) solutions[count++] = poseOf(motion, rays[0].centre, 1);
  return count;
}

// The line from the common centre c to the point X is the fifth ray. Then kappa t + R (X - c) is along the point's bearing p.
int h41(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  const Vector3d toPoint = points[0].point - rays[0].centre;
  const double extent = toPoint.cwiseAbs().maxCoeff();
  if (!(extent > 0) || !std::isfinite(extent)) return 0;
  RayMatch five[FivePoints::kRays];
  std::copy(rays, rays + 4, five);
  five[4] = {points[0].u, points[0].v, rays[0].centre, (toPoint / extent).normalized(), rays[0].camera};
  const double distance = extent * (toPoint / extent).norm();
  const Vector3d p = bearingOf(points[0].u, points[0].v);
  int count = 0;
  for (const FivePoints::Motion& motion : FivePoints(five)) {
    const Vector3d pt = p.cross(motion.t);
    const double kappa = -pt.dot(p.cross(motion.R * five[4].direction)) / pt.squaredNorm();
    if (kappa > 0 && std::isfinite(kappa)) solutions[count++] = poseOf(motion, rays[0].centre, kappa * distance);
  }
  return count;
}

// The sixth ray, along q through c6, is linear in the distance: v . ((kappa t + R (c6 - c)) x R q) = 0.
int h60(const RayMatch* rays, const PointMatch*, FocalPose* solutions) {
  const int odd = oddOne(rays);
  const RayMatch& sixth = rays[odd];
  RayMatch five[FivePoints::kRays];
  std::copy(rays, rays + odd, five);
  std::copy(rays + odd + 1, rays + 6, five + odd);
  const Vector3d baseline = sixth.centre - five[0].centre;
  const double unit = baseline.cwiseAbs().maxCoeff();
  if (!(unit > 0) || !std::isfinite(unit)) return 0;
  const Vector3d v = bearingOf(sixth.u, sixth.v);
  double imageScale = 0;
  for (int i = 0; i < 6; ++i) imageScale = std::max({imageScale, std::abs(rays[i].u), std::abs(rays[i].v)});
  int count = 0;
  for (const FivePoints::Motion& motion : FivePoints(five)) {
    const Vector3d a = motion.R * sixth.direction, between = motion.R * (baseline / unit), va = v.cross(a);
    const double kappa = -between.dot(va) / motion.t.dot(va);
    if (!(kappa > 0) || !std::isfinite(kappa)) continue;
    const Vector3d centre = kappa * motion.t + between;
    if (isMetInFront(sixth, centre / std::max(kappa, 1.), a, imageScale))
      solutions[count++] = poseOf(motion, five[0].centre, kappa * unit);
  }
  return count;
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv
