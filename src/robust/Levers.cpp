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

Levers leversOf(const LeastSquaresProblem& problem, const QueryPose& pose, RayTreatment treatment) {
  Levers result;
  LeastSquaresProblem without = problem;
  for (std::vector<std::size_t> levers;; levers.clear()) {
    const correspondences::PaddedValues narrowing = treatment.narrowing();
    without.rays.narrowing = narrowing.pointer();
    std::vector<double> leverages = rayLeverages(without, pose);
    for (std::size_t i = 0; i < leverages.size(); ++i)
      if (leverages[i] > kLever) levers.push_back(i);
    if (result.rays.empty()) result.leverages = std::move(leverages);
    if (levers.empty()) return result;
    treatment.refuse(levers);
    result.rays.insert(result.rays.end(), levers.begin(), levers.end());
  }
}

}  // namespace robust
}  // namespace hybridgv
