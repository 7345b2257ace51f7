#include "solvers/complex_rays/straightWay.hpp"
#include "solvers/h70f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

Homotopy<double> straightHomotopy(const Parameters& start, const Parameters& target) {
  Homotopy<double> path;
  for (int j = 0; j < kRays; ++j) path.ray[j] = complex_rays::straightWay(start, target, j);
  return path;
}

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
