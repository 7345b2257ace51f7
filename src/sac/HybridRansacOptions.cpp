#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "CheckArguments.hpp"
#include "hybridgv/detail/format.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/Lens.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace sac {

std::vector<SolverPrior> defaultSolvers() {
  std::vector<SolverPrior> result;
  for (const solvers::SolverRows& problem : solvers::minimalProblems()) {
    const solvers::MinimalSolver& solver = *problem.begin();
    if (solver.id && solver.prior > 0 && !solver.intrinsics.radial) result.push_back({*solver.id, solver.prior});
  }
  return result;
}

template <class Number>
static void require(bool holds, const char* name, Number value, const char* expected) {
  if (!holds) throwInvalid(std::string("options.") + name, "must be " + std::string(expected) + ", is " + detail::format(value));
}

template <class Enumeration>
static void requireListed(const std::vector<Enumeration>& values, const char* name, Enumeration value) {
  if (std::find(values.begin(), values.end(), value) == values.end())
    throwInvalid(std::string("options.") + name, "no such value: " + std::to_string(static_cast<int>(value)));
}

static void checkFocalLength(const HybridRansacOptions& options) {
  const auto checkValue = [&](const char* name, const std::optional<double>& value) {
    if (!value) return;
    require(*value > 0 && std::isfinite(*value), name, *value, "positive and finite");
    require(*value >= options.minFocalLength && *value <= options.maxFocalLength, name, *value,
            "between minFocalLength and maxFocalLength");
  };
  checkValue("knownFocalLengthPx", options.knownFocalLengthPx);
  checkValue("focalLengthPriorPx", options.focalLengthPriorPx);
  const double deviation = options.focalLengthPriorLogDeviation;
  require(deviation > 0 && std::isfinite(deviation), "focalLengthPriorLogDeviation", deviation, "positive and finite");
  if (options.knownFocalLengthPx && options.focalLengthPriorPx)
    throwInvalid("options.focalLengthPriorPx",
                 "has no meaning beside knownFocalLengthPx, is " + detail::format(*options.focalLengthPriorPx));
  const auto estimatesIt = [](const SolverPrior& entry) { return solvers::rowsOf(entry.solver).begin()->intrinsics.focalLength; };
  const auto needsIt = [&](const SolverPrior& entry) { return !estimatesIt(entry) && solvers::rowsOf(entry.solver).rays() > 0; };
  if (!options.knownFocalLengthPx && !options.focalLengthPriorPx && !options.solvers.empty() &&
      std::all_of(options.solvers.begin(), options.solvers.end(), needsIt))
    throwInvalid("options.solvers", "all need the focal length: neither knownFocalLengthPx nor focalLengthPriorPx is given");
  if (options.knownFocalLengthPx && !options.solvers.empty() &&
      std::all_of(options.solvers.begin(), options.solvers.end(), estimatesIt))
    throwInvalid("options.solvers",
                 "all estimate the focal length, but knownFocalLengthPx is " + detail::format(*options.knownFocalLengthPx));
}

void HybridRansacOptions::check() const {
  const auto positiveFinite = [](double value) { return value > 0 && std::isfinite(value); };
  const auto isThreshold = [](double value) { return value >= 0 && std::isfinite(value); };
  require(isThreshold(maxReprojectionErrorPx), "maxReprojectionErrorPx", maxReprojectionErrorPx,
          "positive and finite, or 0 (automatic)");
  require(isThreshold(maxEpipolarErrorPx), "maxEpipolarErrorPx", maxEpipolarErrorPx, "positive and finite, or 0 (automatic)");
  require(successProbability > 0 && successProbability < 1, "successProbability", successProbability, "between 0 and 1");
  require(maxIterations > 0, "maxIterations", maxIterations, "positive");
  require(minIterations >= 0, "minIterations", minIterations, "not negative");
  require(timeBudgetSeconds > 0, "timeBudgetSeconds", timeBudgetSeconds, "positive");
  require(minFocalLength >= 0 && std::isfinite(minFocalLength), "minFocalLength", minFocalLength, "finite and not negative");
  require(maxFocalLength > minFocalLength, "maxFocalLength", maxFocalLength,
          ("greater than minFocalLength (" + detail::format(minFocalLength) + ")").c_str());
  require(positiveFinite(maxFocalLengthDeviation), "maxFocalLengthDeviation", maxFocalLengthDeviation, "positive and finite");
  require(principalPointDeviationPx >= 0 && std::isfinite(principalPointDeviationPx), "principalPointDeviationPx",
          principalPointDeviationPx, "finite and not negative");
  requireListed({QueryCamera::Pinhole, QueryCamera::Radial}, "queryCamera", queryCamera);
  require(imageRadiusPx >= 0 && std::isfinite(imageRadiusPx), "imageRadiusPx", imageRadiusPx, "finite and not negative");
  require(positiveFinite(distortionScale), "distortionScale", distortionScale, "positive and finite");
  require(distortionEvidence < std::numeric_limits<double>::infinity(), "distortionEvidence", distortionEvidence,
          "a number below infinity");
  if (distortionHypotheses.empty()) throwInvalid("options.distortionHypotheses", "empty");
  for (const double hypothesis : distortionHypotheses)
    require(hypothesis > robust::kLeastDistortion && hypothesis < robust::kLargestDistortion, "distortionHypotheses", hypothesis,
            "between -0.7 and 0.3");
  require(threads >= 0, "threads", threads, "0 (all cores) or positive");
  if (solvers.empty() && !initialPose) throwInvalid("options.solvers", "empty, and there is no initialPose");
  const std::vector<Solver> known = allSolvers();
  for (const SolverPrior& entry : solvers) {
    requireListed(known, "solvers", entry.solver);
    if (!positiveFinite(entry.prior))
      require(false, ("solvers[" + std::string(hybridgv::toString(entry.solver)) + "].prior").c_str(), entry.prior,
              "positive and finite");
  }
  for (auto entry = solvers.begin(); entry != solvers.end(); ++entry)
    for (auto other = solvers.begin(); other != entry; ++other)
      if (other->solver == entry->solver)
        throwInvalid("options.solvers", std::string(hybridgv::toString(entry->solver)) + " is listed twice");
  checkFocalLength(*this);
  requireListed({Scoring::Msac, Scoring::InlierCount}, "scoring", scoring);
  requireListed({Sampling::Uniform, Sampling::QualityOrdered}, "sampling", sampling);
  if (!initialPose) return;
  checkPose("options.initialPose", *initialPose);
  const double focalLength = initialPose->focalLength;
  require(focalLength >= minFocalLength && focalLength <= maxFocalLength, "initialPose: its focal length", focalLength,
          "between minFocalLength and maxFocalLength");
}

const char* toString(FailureReason reason) {
  switch (reason) {
    case FailureReason::None:
      return "none";
    case FailureReason::TooFewCorrespondences:
      return "too few correspondences";
    case FailureReason::NoModel:
      return "no pose with inliers";
    case FailureReason::InliersMayBeChance:
      return "inliers may be chance";
    case FailureReason::UndeterminedPose:
      return "pose not determined by the inliers";
    case FailureReason::AmbiguousPose:
      return "another pose is as good";
  }
  throwInvalid("reason", "no such value: " + std::to_string(static_cast<int>(reason)));
}

const char* toString(StopReason reason) {
  switch (reason) {
    case StopReason::NotStarted:
      return "not started";
    case StopReason::Confident:
      return "confident";
    case StopReason::MaxIterations:
      return "maximum of iterations";
    case StopReason::TimeBudget:
      return "time budget";
    case StopReason::NoMoreSamples:
      return "no more samples";
  }
  throwInvalid("reason", "no such value: " + std::to_string(static_cast<int>(reason)));
}

}  // namespace sac
}  // namespace hybridgv
