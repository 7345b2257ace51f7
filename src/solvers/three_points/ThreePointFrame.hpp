// Three 2D-3D points seen with an unknown focal length f: the frame in which they become three linear relations. Derived in
// src/doc/three_points.md, sections "Notation" and "The frame", whose letters the members have.
//
// The query sees the rig point X at p = f (x + i y) / depth, (x, y, depth) = R X + t. With the rows r1, r2, r3 of R let
// z = f (r1 + i r2), n = r3. Then n.n = 1, z.n = z.z = 0, n x z = -i z, and for any rig vector Y from point X3
//
//     E(Y) = z.Y - p n.Y + (p3 - p) d3,   d3 the depth of X3,
//
// vanishes iff X3 + Y is seen at p.
//
// Frame: e1 along X2 - X1, e3 normal to the plane of the points, origin at the foot of the altitude of X3:
// X1 = (a1, 0, 0), X2 = (b1, 0, 0), X3 = (0, -h, 0). With n = (u, v, n3) and d = depth of the origin, the equations of the points
// give z1 = z.e1 and z2 = z.e2 linearly in (u, v, d):
//
//     z1 = A11 u + D1 d,   z2 = A21 u + p3 v + D2 d.
//
// Units: the largest image coordinate and the length X1X2 are 1.
#pragma once

#include <Eigen/Core>

#include "math/Planar.hpp"
#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {

using math::ImagePoint;

struct ThreePointFrame {
  // In the rig's frame and unit: the axes, and the point X3.
  Eigen::Vector3d e1, e2, e3;
  Eigen::Vector3d x3;
  // One unit here in the caller's units.
  double imageUnit, lengthUnit;
  // X1 = (a1, 0, 0), X2 = (b1, 0, 0), X3 = (0, -h, 0), and where they are seen.
  double a1, b1, h;
  ImagePoint p1, p2, p3;
  // Coefficients of z1 and z2, as complex numbers.
  ImagePoint A11, A21, D1, D2;

  // Components of a direction of the rig's frame.
  Eigen::Vector3d direction(const Eigen::Vector3d& v) const { return {e1.dot(v), e2.dot(v), e3.dot(v)}; }
  // Vector from X3 to a rig point, in this frame and unit.
  Eigen::Vector3d fromX3(const Eigen::Vector3d& point) const { return direction((point - x3) / lengthUnit); }
  ImagePoint image(double u, double v) const { return {u / imageUnit, v / imageUnit}; }

  // False for degenerate data: coincident or collinear points, coincident image points. `otherImage` is the largest absolute
  // image coordinate of the problem's other correspondences.
  bool set(const PointMatch& m1, const PointMatch& m2, const PointMatch& m3, double otherImage);
};

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
