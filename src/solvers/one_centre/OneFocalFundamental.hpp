// Six image correspondences between a query camera of unknown focal length f and one calibrated camera: the fundamental matrix,
// f and the relative rotation.
//
// With image points p = (u, v, 1) of the query and directions q in the calibrated camera's frame the epipolar constraints are
//
//     p_k^T F q_k = 0, k = 1..6,     F = diag(1/f, 1/f, 1) E,   E = [t]x R essential up to scale.
//
// They leave the pencil F = x B0 + y B1 + w B2. The rows f1, f2, f3 of F obey (the conditions on E, f eliminated)
//
//     det F = 0,      Q = (f1.f3) (f1 x f3) + (f2.f3) (f2 x f3) = 0,
//
// one cubic and three quartics with 9 common zeros. Where det B0 is not 0, the cubic reduces the quartics, for each direction
// (y : w) = (c : s), to three quadratics in x, M(c, s) (x^2, x, 1)^T = 0, and
//
//     det M(c, s) is a binary form of degree exactly 9,
//
// whose real roots give x from the null vector of M. (Null space: EpipolarNullSpace; the form: OneFocalPencil.) If the image
// point p_k is the principal point, then f3 = 0 is one of the pencil's matrices. It solves everything, belongs to f = 0, and is a
// double root, which is divided out (degree 7).
#pragma once

#include <Eigen/Core>

#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

constexpr int kSix = 6;

// The six correspondences.
struct SixCorrespondences {
  double u[kSix], v[kSix];           // image points, divided by imageScale = their largest coordinate
  double x[kSix], y[kSix], z[kSix];  // viewing directions of the calibrated camera, of length 1
  double imageScale;

  void set(int k, double imageU, double imageV, const Eigen::Vector3d& direction) {
    u[k] = imageU;
    v[k] = imageV;
    x[k] = direction[0];
    y[k] = direction[1];
    z[k] = direction[2];
  }
  // Divides u, v by their largest magnitude; false if all are 0.
  bool normalize();
  // Six rays, and normalizes them.
  bool setRays(const RayMatch* rays);
};

// Pose up to the length of the baseline, where all six points lie in front of both cameras.
struct OneFocalMotion {
  double focalLength;               // for the normalized image points
  Eigen::Matrix3d rotation;         // R, calibrated camera -> query
  Eigen::Vector3d baseline;         // b, unit, from the query's centre to the calibrated camera's, in the latter's frame
  Eigen::Vector3d baselineInQuery;  // R b
};

constexpr int kMaxOneFocalMotions = 9;

// Returns the number of solutions; 0 where F is not determined (fewer than six independent constraints, six coplanar points, no
// baseline).
int oneFocalFundamental(const SixCorrespondences& correspondences, OneFocalMotion* motions);

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv
