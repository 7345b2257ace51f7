// Straight ways from one system (t = 0) to another (t = 1).
#pragma once

#include <complex>

#include "solvers/complex_rays/ComplexRays.hpp"

namespace hybridgv {
namespace solvers {
namespace complex_rays {

inline std::complex<double> number(const ComplexNumber& a) { return {a.re, a.im}; }
inline ComplexNumber plain(const std::complex<double>& a) { return {a.real(), a.imag()}; }

math::Polynomial<double, 1> straightWay(const ComplexNumber& start, const ComplexNumber& end);
VectorHomotopy<double> straightWay(const ComplexNumber (&start)[3], const ComplexNumber (&end)[3]);

// Of ray j.
template <int Rays>
RayHomotopy<double> straightWay(const ComplexRays<Rays>& start, const ComplexRays<Rays>& end, int j) {
  return {straightWay(start.direction[j], end.direction[j]), straightWay(start.moment[j], end.moment[j]),
          straightWay(start.image[j], end.image[j]), straightWay(start.imageBar[j], end.imageBar[j])};
}

}  // namespace complex_rays
}  // namespace solvers
}  // namespace hybridgv
