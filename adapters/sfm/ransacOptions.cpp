#include "hybridgv/adapters/sfm/ransacOptions.hpp"

#include <cmath>

namespace hybridgv {
namespace sfm {

sac::HybridRansacOptions ransacOptions(const LocalizationProblem& problem, sac::HybridRansacOptions options) {
  options.queryCamera = problem.isUndistorted ? sac::QueryCamera::Pinhole : sac::QueryCamera::Radial;
  if (options.imageRadiusPx == 0)
    options.imageRadiusPx = std::hypot(static_cast<double>(problem.imageWidth), static_cast<double>(problem.imageHeight)) / 2;
  return options;
}

}  // namespace sfm
}  // namespace hybridgv
