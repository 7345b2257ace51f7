#include "robust/Leverage.hpp"

#include <algorithm>

#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

// A ray that alone fixes a direction has leverage 1 and no error; nothing can be said about it.
constexpr double kMaxLeverage = 0.99;

}  // namespace

std::vector<double> predictedVariances(const LeastSquaresProblem& problem, const QueryPose& pose,
                                       const ParameterMatrix& covariance) {
  std::vector<double> variances(correspondences::padded(problem.rays.size), 0);
  const ParameterMatrix all = byKernelParameters(covariance, problem.estimated);
  problem.kernels->rayLeverages(problem.rays, toPlain(pose), problem.rayLoss, all.data(), variances.data());
  variances.resize(problem.rays.size);
  return variances;
}

std::vector<double> rayLeverages(const LeastSquaresProblem& problem, const QueryPose& pose) {
  ParameterMatrix covariance;
  if (problem.kinds.rays && invertInformation(information(problem, pose), covariance))
    return predictedVariances(problem, pose, covariance);
  return std::vector<double>(problem.rays.size, 0);
}

std::vector<double> narrowingByLeverage(std::vector<double> leverages) {
  for (double& value : leverages) value = 1 / (1 - std::clamp(value, 0., kMaxLeverage));
  return leverages;
}

}  // namespace robust
}  // namespace hybridgv
