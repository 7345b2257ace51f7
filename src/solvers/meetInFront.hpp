#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hybridgv {
namespace solvers {

// Do the viewing rays of the query through (u, v) and of a rig camera along the unit vector a (in the query's frame) meet in
// front of both, where the rig camera's centre lies in the direction t (unit, in the query's frame)?
//
//     kappa t + beta a = lambda p,  p = (u, v, f):  beta > 0, lambda > 0 for a kappa > 0.
//
// Multiplied by p and by a, with n = p x a normal to the epipolar plane:  kappa n.(p x t) = -beta |n|^2,
// kappa n.(a x t) = -lambda |n|^2. A ray through the other camera's centre has no such point; neither has, here, one that passes
// it at an angle below 1e-10.
//
// 1 if they do, -1 if they do with the centre in the direction -t, otherwise 0.
inline int meetingSide(double u, double v, double f, const Eigen::Vector3d& a, const Eigen::Vector3d& t) {
  constexpr double kLeast = 1e-10 * 1e-10;  // sine^2 of the angle between t and p or a
  const Eigen::Vector3d p(u, v, f), n = p.cross(a);
  const double npt = n.dot(p.cross(t)), nat = n.dot(a.cross(t)), nn = n.squaredNorm();
  const bool isTold = npt * npt > kLeast * p.squaredNorm() * nn && nat * nat > kLeast * nn;
  if (!isTold) return 0;
  return npt < 0 && nat < 0 ? 1 : (npt > 0 && nat > 0 ? -1 : 0);
}

inline bool meetInFront(double u, double v, double f, const Eigen::Vector3d& a, const Eigen::Vector3d& t) {
  return meetingSide(u, v, f, a, t) == 1;
}

}  // namespace solvers
}  // namespace hybridgv
