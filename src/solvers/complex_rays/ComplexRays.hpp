// Rays and image points in complex numbers: the data of the problems that are solved by following paths. No Eigen type, because
// some parts are compiled for other instruction sets.
#pragma once

#include "math/homotopy/Data.hpp"

namespace hybridgv {
namespace solvers {
namespace complex_rays {

struct ComplexNumber {
  double re, im;
};

// Image points pi = u + i v and pib = u - i v are independent on the way from one problem to another, and so are the direction q
// and the moment m = q x c of a ray through c (m.q = 0 need not hold: the number of solutions is the same for lines and for linear
// line complexes).
template <int Rays>
struct ComplexRays {
  ComplexNumber direction[Rays][3], moment[Rays][3];
  ComplexNumber image[Rays], imageBar[Rays];
};

// The same on the straight way from one problem (t = 0) to another (t = 1).
template <class Scalar>
struct VectorHomotopy {  // w+ = w1 + i w2, w- = w1 - i w2, w3
  math::Polynomial<Scalar, 1> plus, minus, third;
};
template <class Scalar>
struct RayHomotopy {
  VectorHomotopy<Scalar> direction, moment;
  math::Polynomial<Scalar, 1> image, imageBar;
};

}  // namespace complex_rays
}  // namespace solvers
}  // namespace hybridgv
