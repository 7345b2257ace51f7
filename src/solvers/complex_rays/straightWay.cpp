#include "solvers/complex_rays/straightWay.hpp"

namespace hybridgv {
namespace solvers {
namespace complex_rays {

static math::Polynomial<double, 1> straightWay(const std::complex<double>& start, const std::complex<double>& end) {
  const std::complex<double> slope = end - start;
  return {{start.real(), slope.real()}, {start.imag(), slope.imag()}};
}

math::Polynomial<double, 1> straightWay(const ComplexNumber& start, const ComplexNumber& end) {
  return straightWay(number(start), number(end));
}

VectorHomotopy<double> straightWay(const ComplexNumber (&start)[3], const ComplexNumber (&end)[3]) {
  const std::complex<double> i(0, 1);
  const auto plus = [i](const ComplexNumber(&w)[3]) { return number(w[0]) + i * number(w[1]); };
  const auto minus = [i](const ComplexNumber(&w)[3]) { return number(w[0]) - i * number(w[1]); };
  return {straightWay(plus(start), plus(end)), straightWay(minus(start), minus(end)), straightWay(start[2], end[2])};
}

}  // namespace complex_rays
}  // namespace solvers
}  // namespace hybridgv
