// Plain data that the parts of the H51f solver hand to each other; no Eigen type, because some of them are compiled for other
// instruction sets.
#pragma once

#include "solvers/complex_rays/ComplexRays.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using complex_rays::ComplexNumber;

constexpr int kRays = 5;
constexpr int kUnknowns = 5;  // x, y, alpha, beta, d, see System.hpp
constexpr int kMaxPaths = 56;

// The data of a problem, complexified. Origin of the rig at the 3D point.
struct Parameters : complex_rays::ComplexRays<kRays> {
  ComplexNumber pointImage, pointImageBar;  // of the 3D point
};

// The number of solutions depends on how many rays share a centre. Three cases differ. A centre shared by three or four rays is
// kept at (0, 0, kSharedCentre) by the choice of coordinates, and those rays come first.
enum class Sharing { AtMostTwo, Three, Four };
constexpr double kSharedCentre = 3;

// A system whose solutions are all known.
struct StartSystem {
  Sharing sharing;
  int paths;
  Parameters parameters;
  const math::Point<float, kUnknowns>* solutions;  // x, y, alpha, beta, d
};

// The data of the equations on the straight way from one system (t = 0) to another (t = 1).
template <class Scalar>
struct RayHomotopy : complex_rays::RayHomotopy<Scalar> {
  math::Polynomial<Scalar, 2> cross;  // pib pi0 - pi pib0
};
template <class Scalar>
struct Homotopy {
  RayHomotopy<Scalar> ray[kRays];
  math::Polynomial<Scalar, 1> pointImage, pointImageBar;
};

Homotopy<double> straightHomotopy(const Parameters& start, const Parameters& target);

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
