// Plain data that the parts of the H51f solver hand to each other; no Eigen type, because some of them are compiled for other
// instruction sets.
#pragma once

#include "math/homotopy/Data.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

constexpr int kRays = 5;
constexpr int kUnknowns = 5;  // x, y, alpha, beta, d, see System.hpp
constexpr int kMaxPaths = 56;

struct ComplexNumber {
  double re, im;
};

// The data of a problem, complexified: image points pi = u + i v and pib = u - i v are independent on the way from one problem to
// another, and so are the direction q and the moment m = q x c of a ray through c (m.q = 0 need not hold: the number of solutions
// is the same for lines and for linear line complexes). Origin of the rig at the 3D point.
struct Parameters {
  ComplexNumber direction[kRays][3], moment[kRays][3];
  ComplexNumber image[kRays], imageBar[kRays];
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
struct VectorHomotopy {  // w+ = w1 + i w2, w- = w1 - i w2, w3
  math::Polynomial<Scalar, 1> plus, minus, third;
};
template <class Scalar>
struct RayHomotopy {
  VectorHomotopy<Scalar> direction, moment;
  math::Polynomial<Scalar, 1> image, imageBar;
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
