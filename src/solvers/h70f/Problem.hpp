// Plain data that the parts of the H70f solver hand to each other; no Eigen type, because some of them are compiled for other
// instruction sets.
#pragma once

#include "solvers/complex_rays/ComplexRays.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

using complex_rays::ComplexNumber;

constexpr int kRays = 7;
constexpr int kUnknowns = 7;  // x, y, taub, tau, t3, alpha, beta, see System.hpp
constexpr int kMaxPaths = 118;

using Parameters = complex_rays::ComplexRays<kRays>;

// The number of solutions depends on how many rays share a centre, and on whether those left over do too: the sizes of the groups
// of three rays or more. The last rays are those of the first group, whose centre is the origin; before them stand those of the
// second, if there is one, whose centre is (0, 0, kSecondCentre).
//
// They are last because the first pass of the path solver does not pivot: five rays of the origin have no moment, so that their
// equations are linear and homogeneous in (taub, tau, t3), and as the first five they would be singular at the solution.
enum class Sharing { AtMostTwo, Three, ThreeThree, Four, FourThree, Five };
constexpr double kSecondCentre = 3;

// A system whose solutions are all known.
struct StartSystem {
  Sharing sharing;
  int paths;
  Parameters parameters;
  const math::Point<float, kUnknowns>* solutions;
};

// The data of the equations on the straight way from one system (t = 0) to another (t = 1).
template <class Scalar>
struct Homotopy {
  complex_rays::RayHomotopy<Scalar> ray[kRays];
};

Homotopy<double> straightHomotopy(const Parameters& start, const Parameters& target);

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
