#include "robust/SampleCheck.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {
namespace {

constexpr double kSmall = 1e-6;  // relative

template <class A, class B>
bool seenAtSamePlace(const A& a, const B& b) {
  const double extent = std::max({std::abs(a.u), std::abs(a.v), std::abs(b.u), std::abs(b.v)});
  return std::max(std::abs(a.u - b.u), std::abs(a.v - b.v)) <= kSmall * extent;
}

bool areCollinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  return ab.cross(ac).norm() <= kSmall * longest;
}

bool passesThrough(const correspondences::RayMatch& ray, const Eigen::Vector3d& point) {
  const Eigen::Vector3d toPoint = point - ray.centre;
  return ray.direction.cross(toPoint).norm() <= kSmall * toPoint.norm();
}

bool isSameRay(const correspondences::RayMatch& a, const correspondences::RayMatch& b) {
  return a.camera == b.camera && a.direction.cross(b.direction).norm() <= kSmall;
}

}  // namespace

bool isDegenerate(const correspondences::RayMatch* rays, int numberRays, const correspondences::PointMatch* points,
                  int numberPoints) {
  if (numberPoints >= 3 && areCollinear(points[0].point, points[1].point, points[2].point)) return true;
  for (int i = 0; i < numberPoints; ++i)
    for (int j = 0; j < i; ++j)
      if (seenAtSamePlace(points[i], points[j])) return true;
  for (int i = 0; i < numberRays; ++i) {
    for (int j = 0; j < i; ++j)
      if (isSameRay(rays[i], rays[j])) return true;
    for (int j = 0; j < numberPoints; ++j)
      if (passesThrough(rays[i], points[j].point)) return true;
  }
  return false;
}

}  // namespace robust
}  // namespace hybridgv
