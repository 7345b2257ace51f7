// Plain data of the path tracker, the same for every instruction set.
#pragma once

namespace hybridgv {
namespace math {

// A complex polynomial of a real variable, c[0] + c[1] t + c[2] t^2 ..: how a coefficient of a system depends on the homotopy
// parameter.
template <class Scalar, int Degree>
struct Polynomial {
  Scalar re[Degree + 1], im[Degree + 1];
};

// A point of C^N.
template <class Scalar, int N>
struct Point {
  Scalar re[N], im[N];
};

}  // namespace math
}  // namespace hybridgv
