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

namespace hybridgv {
namespace solvers {

constexpr int kSix = 6;

// The six correspondences, image points divided by imageScale = their largest coordinate.
struct SixCorrespondences {
  double u[kSix], v[kSix];
  double imageScale;
  Eigen::Vector3d direction[kSix];  // unit length

  // Divides u, v by their largest magnitude; false if all are 0.
  bool normalise();
};

// A solution up to the sign of b and the choice between two rotations:  E = [R b]x R.
struct OneFocalMotion {
  double focalLength;               // for the normalised image points
  Eigen::Vector3d baseline;         // b, unit, in the calibrated camera's frame: the query's centre is at +b or -b
  Eigen::Matrix3d rotation;         // R, calibrated camera -> query; the other one is (2 (R b)(R b)^T - I) R
  Eigen::Vector3d baselineInQuery;  // R b, the same for both rotations

  Eigen::Matrix3d otherRotation() const { return 2 * baselineInQuery * (baselineInQuery.transpose() * rotation) - rotation; }
};

constexpr int kMaxOneFocalMotions = 9;

// Returns the number of solutions; 0 where F is not determined (fewer than six independent constraints, six coplanar points, no
// baseline).
int oneFocalFundamental(const SixCorrespondences& correspondences, OneFocalMotion* motions);

// Do the viewing rays of the query through (u, v) and of the calibrated camera along the unit vector a (in the query's frame)
// meet in front of both, where the calibrated camera's centre lies in the direction T (unit, in the query's frame)?
//
//     kappa T + beta a = lambda (u, v, f):  beta > 0, lambda > 0 for a kappa > 0.
//
// A ray through the other camera's centre, or almost, has no such point.
bool meetInFront(double u, double v, double f, const Eigen::Vector3d& a, const Eigen::Vector3d& T);

}  // namespace solvers
}  // namespace hybridgv
