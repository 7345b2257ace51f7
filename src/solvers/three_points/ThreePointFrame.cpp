#include "solvers/three_points/ThreePointFrame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace solvers {
namespace three_points {

// Below this sine of an angle of the triangle, or distance of image points, the data count as degenerate.
constexpr double kCoincident = 1e-9;
// Above this sine, rounding leaves the axes as orthonormal as doubles can be.
constexpr double kThin = 1e-2;

static double distance(const ImagePoint& a, const ImagePoint& b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }

bool ThreePointFrame::set(const PointMatch& m1, const PointMatch& m2, const PointMatch& m3, double otherImage) {
  imageUnit =
      std::max({otherImage, std::abs(m1.u), std::abs(m1.v), std::abs(m2.u), std::abs(m2.v), std::abs(m3.u), std::abs(m3.v)});
  const Eigen::Vector3d edge = m2.point - m1.point, side = m1.point - m3.point;
  lengthUnit = edge.norm();
  const double sideLength = side.norm();
  if (!(imageUnit > 0) || !(lengthUnit > 0)) return false;
  e1 = edge / lengthUnit;
  Eigen::Vector3d normal = side.cross(e1);
  const double altitude = normal.norm();
  if (!(altitude > kCoincident * std::max(sideLength, lengthUnit))) return false;
  // Of vectors that are almost parallel the product is not quite perpendicular to either, by as much as has cancelled in it.
  if (altitude < kThin * sideLength) normal -= e1.dot(normal) * e1;
  e3 = normal.normalized();
  e2 = e3.cross(e1);
  x3 = m3.point;
  a1 = side.dot(e1) / lengthUnit;
  b1 = a1 + 1;
  h = side.dot(e2) / lengthUnit;
  p1 = image(m1.u, m1.v);
  p2 = image(m2.u, m2.v);
  p3 = image(m3.u, m3.v);
  if (distance(p1, p2) < kCoincident || distance(p2, p3) < kCoincident || distance(p3, p1) < kCoincident) return false;
  D1 = p2 - p1;
  A11 = b1 * p2 - a1 * p1;
  A21 = (-a1 * b1 / h) * D1;
  D2 = (1 / h) * (p1 - a1 * D1 - p3);
  return true;
}

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
