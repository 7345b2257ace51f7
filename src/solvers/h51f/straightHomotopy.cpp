#include "solvers/complex_rays/straightWay.hpp"
#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using complex_rays::number;
using complex_rays::straightWay;
using Number = std::complex<double>;

static void setCoefficient(math::Polynomial<double, 2>& p, int power, const Number& value) {
  p.re[power] = value.real();
  p.im[power] = value.imag();
}

Homotopy<double> straightHomotopy(const Parameters& start, const Parameters& target) {
  Homotopy<double> path;
  path.pointImage = straightWay(start.pointImage, target.pointImage);
  path.pointImageBar = straightWay(start.pointImageBar, target.pointImageBar);
  const Number pi0 = number(start.pointImage), pib0 = number(start.pointImageBar);
  const Number dPi0 = number(target.pointImage) - pi0, dPib0 = number(target.pointImageBar) - pib0;
  for (int j = 0; j < kRays; ++j) {
    RayHomotopy<double>& ray = path.ray[j];
    static_cast<complex_rays::RayHomotopy<double>&>(ray) = straightWay<kRays>(start, target, j);
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
