#include "robust/Leverage.hpp"

#include <algorithm>

#include "correspondences/arrayParts.hpp"
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
  const PlainPose plain = toPlain(pose);
  constexpr std::size_t kTogether = 256;
  static_assert(kTogether % correspondences::kPadding == 0, "a part begins where the kernels may begin");
  forParts(problem.workers, problem.rays.size, kTogether, [&](std::size_t begin, std::size_t end) {
    const RayArrays part = correspondences::part(problem.rays, begin, end);
    problem.kernels->rayLeverages(part, plain, problem.rayLoss, all.data(), variances.data() + begin);
  });
  variances.resize(problem.rays.size);
  return variances;
}

std::vector<double> rayLeverages(const LeastSquaresProblem& problem, const QueryPose& pose) {
  return rayLeverages(problem, pose, information(problem, pose));
}

std::vector<double> rayLeverages(const LeastSquaresProblem& problem, const QueryPose& pose, const ParameterMatrix& information) {
  ParameterMatrix covariance;
  if (problem.kinds.rays && invertInformation(information, covariance)) return predictedVariances(problem, pose, covariance);
  return std::vector<double>(problem.rays.size, 0);
}

std::vector<double> narrowingByLeverage(std::vector<double> leverages) {
  for (double& value : leverages) value = 1 / (1 - std::clamp(value, 0., kMaxLeverage));
  return leverages;
}

}  // namespace robust
}  // namespace hybridgv
