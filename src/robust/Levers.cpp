#include "robust/Levers.hpp"

#include <limits>
#include <utility>

#include "robust/Leverage.hpp"

namespace hybridgv {
namespace robust {
namespace {

// A ray with a larger leverage than this decides more about its own error than all others together.
constexpr double kLever = 0.5;
// The narrowing of a refused ray: its loss has no weight and no cost, whatever its error. (A finite one would leave all weight to
// an error of 0.)
constexpr double kRefused = std::numeric_limits<double>::infinity();

}  // namespace

void RayTreatment::refuse(const std::vector<std::size_t>& rays) {
  for (const std::size_t i : rays) {
    refused_.push_back(i);
    narrowing_[i] = kRefused;
  }
  isNeeded_ = isNeeded_ || !rays.empty();
}

void RayTreatment::setNarrowing(std::vector<double> narrowing) {
  narrowing_ = std::move(narrowing);
  for (const std::size_t i : refused_) narrowing_[i] = kRefused;
  isNeeded_ = true;
}

void RayTreatment::leaveOut(std::vector<double>& squaredErrors) const {
  for (const std::size_t i : refused_)
    if (i < squaredErrors.size()) squaredErrors[i] = std::numeric_limits<double>::infinity();
}

correspondences::PaddedValues RayTreatment::narrowing() const {
  return isNeeded_ ? correspondences::PaddedValues(narrowing_, 1) : correspondences::PaddedValues();
}

static ParameterMatrix informationOf(LeastSquaresProblem problem, const QueryPose& pose, const RayTreatment& treatment) {
  const correspondences::PaddedValues narrowing = treatment.narrowing();
  problem.rays.narrowing = narrowing.pointer();
  return information(problem, pose);
}

Levers leversOf(const LeastSquaresProblem& problem, const QueryPose& pose, RayTreatment treatment) {
  ParameterMatrix information = informationOf(problem, pose, treatment);
  return leversOf(problem, pose, std::move(treatment), std::move(information));
}

Levers leversOf(const LeastSquaresProblem& problem, const QueryPose& pose, RayTreatment treatment, ParameterMatrix information) {
  Levers result;
  result.others = std::move(information);
  LeastSquaresProblem without = problem;
  for (std::vector<std::size_t> levers;; levers.clear()) {
    const correspondences::PaddedValues narrowing = treatment.narrowing();
    without.rays.narrowing = narrowing.pointer();
    std::vector<double> leverages = rayLeverages(without, pose, result.others);
    for (std::size_t i = 0; i < leverages.size(); ++i)
      if (leverages[i] > kLever) levers.push_back(i);
    if (result.rays.empty()) result.leverages = std::move(leverages);
    if (levers.empty()) return result;
    treatment.refuse(levers);
    result.rays.insert(result.rays.end(), levers.begin(), levers.end());
    result.others = informationOf(problem, pose, treatment);
  }
}

}  // namespace robust
}  // namespace hybridgv
