// Views along the normal of the plane of three points (rho = 0), where the angle of ThreePointSheets.hpp means nothing.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "solvers/three_points/ThreePointPose.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {

// z, n and d3 as functions of (u, v, d), for n3 = side sqrt(1 - u^2 - v^2), side = +-1.
struct FrontoParallelPoint {
  double u, v, d, n3;
  ImagePoint z1, z2, z3;
  // The remaining equations of the three points: (1 - v^2) z1 + (u v + i n3) z2 = 0, with its derivatives.
  struct Row {
    ImagePoint value, u, v, d;
  };
  Row threePoints;

  bool update(const ThreePointFrame& frame, double side) {
    const double square = 1 - u * u - v * v;
    if (!(square > 0)) return false;
    n3 = side * std::sqrt(square);
    z1 = u * frame.A11 + d * frame.D1;
    z2 = u * frame.A21 + v * frame.p3 + d * frame.D2;
    z3 = timesI(u * z2 - v * z1);
    const ImagePoint a{1 - v * v, 0}, b{u * v, n3}, bU{v, -u / n3}, bV{u, -v / n3};
    threePoints.value = product(a, z1) + product(b, z2);
    threePoints.u = product(a, frame.A11) + product(bU, z2) + product(b, frame.A21);
    threePoints.v = (-2 * v) * z1 + product(bV, z2) + product(b, frame.p3);
    threePoints.d = product(a, frame.D1) + product(b, frame.D2);
    return true;
  }

  // E(q) = z.q - p n.q
  Row direction(const ThreePointFrame& frame, const ImagePoint& p, const Eigen::Vector3d& q) const {
    const ImagePoint z3U = timesI(z2 + u * frame.A21 - v * frame.A11), z3V = timesI(u * frame.p3 - z1),
                     z3D = timesI(u * frame.D2 - v * frame.D1);
    return {q[0] * z1 + q[1] * z2 + q[2] * z3 - (u * q[0] + v * q[1] + n3 * q[2]) * p,
            q[0] * frame.A11 + q[1] * frame.A21 + q[2] * z3U - (q[0] - u / n3 * q[2]) * p,
            q[1] * frame.p3 + q[2] * z3V - (q[1] - v / n3 * q[2]) * p, q[0] * frame.D1 + q[1] * frame.D2 + q[2] * z3D};
  }
  // E(y) = E(direction y) + (p3 - p) d3, d3 = d - h v
  Row point(const ThreePointFrame& frame, const ImagePoint& p, const Eigen::Vector3d& y) const {
    const ImagePoint difference = frame.p3 - p;
    Row row = direction(frame, p, y);
    row.value = row.value + (d - frame.h * v) * difference;
    row.v = row.v - frame.h * difference;
    row.d = row.d + difference;
    return row;
  }

  FramePose pose(const ThreePointFrame& frame) const {
    const Eigen::Vector3d x(z1.x, z2.x, z3.x), y(z1.y, z2.y, z3.y);
    FramePose result;
    result.f = std::sqrt((x.squaredNorm() + y.squaredNorm()) / 2);
    result.r3 = {u, v, n3};
    result.r1 = (x - result.r3 * result.r3.dot(x)).normalized();
    result.r2 = result.r3.cross(result.r1);
    const double depth = d - frame.h * v;
    result.x3 = {frame.p3.x * depth / result.f, frame.p3.y * depth / result.f, depth};
    return result;
  }
};

// Is the image triangle nearly similar to the triangle of the points, with the orientation seen from `side`?
inline bool isFrontoParallel(const ThreePointFrame& frame, double side) {
  const ImagePoint difference = frame.D1 + side * timesI(frame.D2);
  return re(difference, difference) < 0.01 * re(frame.D1, frame.D1);
}

// Gauss-Newton from u = v = 0 for the equations of the three points and one complex equation more,
// `constraint`(FrontoParallelPoint) -> Row; an equation with one real part has the other equal to 0.
template <class Constraint>
bool refineFrontoParallel(FrontoParallelPoint& point, const ThreePointFrame& frame, double side, const Constraint& constraint) {
  double last = 1e300;
  for (int iteration = 0; iteration < 12; ++iteration) {
    if (!point.update(frame, side)) return false;
    const FrontoParallelPoint::Row e = point.threePoints, g = constraint(point);
    Eigen::Matrix<double, 4, 3> jacobian;
    jacobian << e.u.x, e.v.x, e.d.x, e.u.y, e.v.y, e.d.y, g.u.x, g.v.x, g.d.x, g.u.y, g.v.y, g.d.y;
    const Eigen::Vector4d value(e.value.x, e.value.y, g.value.x, g.value.y);
    const Eigen::Matrix3d normal = jacobian.transpose() * jacobian;
    const Eigen::Vector3d step = -normal.inverse() * (jacobian.transpose() * value);
    if (!step.allFinite()) return false;
    point.u += step[0];
    point.v += step[1];
    point.d += step[2];
    const double length = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) / (1 + std::abs(point.d));
    if (length < 1e-9 || (length < 1e-7 && length > last / 2)) return point.update(frame, side);
    last = length;
  }
  return false;
}

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
