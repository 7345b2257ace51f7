#include <complex>

#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using Number = std::complex<double>;

static Number number(const ComplexNumber& a) { return {a.re, a.im}; }

template <int Degree>
static void setCoefficient(math::Polynomial<double, Degree>& p, int power, const Number& value) {
  p.re[power] = value.real();
  p.im[power] = value.imag();
}

static math::Polynomial<double, 1> line(const Number& start, const Number& end) {
  math::Polynomial<double, 1> p;
  setCoefficient(p, 0, start);
  setCoefficient(p, 1, end - start);
  return p;
}
static math::Polynomial<double, 1> line(const ComplexNumber& start, const ComplexNumber& end) {
  return line(number(start), number(end));
}

static VectorHomotopy<double> line(const ComplexNumber (&a)[3], const ComplexNumber (&b)[3]) {
  const Number i(0, 1);
  const auto plus = [i](const ComplexNumber(&w)[3]) { return number(w[0]) + i * number(w[1]); };
  const auto minus = [i](const ComplexNumber(&w)[3]) { return number(w[0]) - i * number(w[1]); };
  return {line(plus(a), plus(b)), line(minus(a), minus(b)), line(a[2], b[2])};
}

Homotopy<double> straightHomotopy(const Parameters& start, const Parameters& target) {
  Homotopy<double> path;
  path.pointImage = line(start.pointImage, target.pointImage);
  path.pointImageBar = line(start.pointImageBar, target.pointImageBar);
  const Number pi0 = number(start.pointImage), pib0 = number(start.pointImageBar);
  const Number dPi0 = number(target.pointImage) - pi0, dPib0 = number(target.pointImageBar) - pib0;
  for (int j = 0; j < kRays; ++j) {
    RayHomotopy<double>& ray = path.ray[j];
    ray.direction = line(start.direction[j], target.direction[j]);
    ray.moment = line(start.moment[j], target.moment[j]);
    ray.image = line(start.image[j], target.image[j]);
    ray.imageBar = line(start.imageBar[j], target.imageBar[j]);
    const Number pi = number(start.image[j]), pib = number(start.imageBar[j]);
    const Number dPi = number(target.image[j]) - pi, dPib = number(target.imageBar[j]) - pib;
    setCoefficient(ray.cross, 0, pib * pi0 - pi * pib0);
    setCoefficient(ray.cross, 1, pib * dPi0 + dPib * pi0 - pi * dPib0 - dPi * pib0);
    setCoefficient(ray.cross, 2, dPib * dPi0 - dPi * dPib0);
  }
  return path;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
