#include "sac_problems/hybrid_pose/isDegenerate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {
namespace {

using correspondences::PointMatch;
using correspondences::RayMatch;
using Eigen::Vector3d;

constexpr double kTolerance = 1e-6;

// |a x b| <= tolerance |a| |b|, also for vectors of length zero
bool areParallel(const Vector3d& a, const Vector3d& b) {
  return a.cross(b).squaredNorm() <= kTolerance * kTolerance * a.squaredNorm() * b.squaredNorm();
}

struct Sample {
  const RayMatch* rays;
  int rayCount;
  const PointMatch* points;
  int pointCount;

  int imagePointCount() const { return rayCount + pointCount; }
  double u(int i) const { return i < rayCount ? rays[i].u : points[i - rayCount].u; }
  double v(int i) const { return i < rayCount ? rays[i].v : points[i - rayCount].v; }
};

bool twoImagePointsCoincide(const Sample& s) {
  double largest = 0;
  for (int i = 0; i < s.imagePointCount(); ++i) largest = std::max({largest, std::abs(s.u(i)), std::abs(s.v(i))});
  for (int i = 0; i < s.imagePointCount(); ++i)
    for (int j = 0; j < i; ++j)
      if (std::hypot(s.u(i) - s.u(j), s.v(i) - s.v(j)) <= kTolerance * largest) return true;
  return false;
}

// Two rays lie on one line if their directions and the line between their centres are all parallel.
bool twoRaysCoincide(const Sample& s) {
  for (int i = 0; i < s.rayCount; ++i)
    for (int j = 0; j < i; ++j)
      if (areParallel(s.rays[i].direction, s.rays[j].direction) &&
          areParallel(s.rays[i].direction, s.rays[i].centre - s.rays[j].centre))
        return true;
  return false;
}

bool aRayMeetsAPoint(const Sample& s) {
  for (int i = 0; i < s.rayCount; ++i)
    for (int j = 0; j < s.pointCount; ++j)
      if (areParallel(s.rays[i].direction, s.points[j].point - s.rays[i].centre)) return true;
  return false;
}

bool twoPointsCoincideOrThreeAreCollinear(const Sample& s) {
  double spread = 0;
  for (int i = 0; i < s.pointCount; ++i) spread = std::max(spread, (s.points[i].point - s.points[0].point).norm());
  for (int i = 0; i < s.pointCount; ++i)
    for (int j = 0; j < i; ++j) {
      const Vector3d side = s.points[i].point - s.points[j].point;
      if (side.norm() <= kTolerance * spread) return true;
      for (int k = 0; k < j; ++k)
        if (areParallel(side, s.points[k].point - s.points[j].point)) return true;
    }
  return false;
}

}  // namespace

bool isDegenerate(const RayMatch* rays, int rayCount, const PointMatch* points, int pointCount) {
  const Sample sample{rays, rayCount, points, pointCount};
  return twoImagePointsCoincide(sample) || twoRaysCoincide(sample) || aRayMeetsAPoint(sample) ||
         twoPointsCoincideOrThreeAreCollinear(sample);
}

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
