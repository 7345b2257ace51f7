#include "robust/Leverage.hpp"

#include <algorithm>
#include <utility>

#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

// A ray that alone fixes a direction has leverage 1 and no error; nothing can be said about it.
constexpr double kMaxLeverage = 0.99;

}  // namespace

std::vector<double> rayLeverages(const LeastSquaresProblem& problem, const QueryPose& pose) {
  std::vector<double> leverages(correspondences::padded(problem.rays.size), 0);
  ParameterMatrix covariance;
  if (problem.kinds.rays && invertInformation(information(problem, pose), covariance)) {
    const ParameterMatrix all = byKernelParameters(covariance, problem.estimated);
    problem.kernels->rayLeverages(problem.rays, toPlain(pose), problem.rayLoss, all.data(), leverages.data());
  }
  leverages.resize(problem.rays.size);
  return leverages;
}

correspondences::PaddedValues narrowingByLeverage(const LeastSquaresProblem& problem, const QueryPose& pose) {
  std::vector<double> result = rayLeverages(problem, pose);
  for (double& value : result) value = 1 / (1 - std::clamp(value, 0., kMaxLeverage));
  return {std::move(result), 1};
}

}  // namespace robust
}  // namespace hybridgv
