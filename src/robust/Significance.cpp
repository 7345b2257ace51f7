#include "robust/Significance.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {
namespace {

// log10 of the expected number of wrong poses that look like the result.
constexpr double kLogFalseAlarms = -6;
// The same without points. A part of the rays can agree with a pose near the right one much better than with one that is wrong in
// every way, and up to half of them are inliers there.
constexpr double kLogFalseAlarmsOfRays = -25;

}  // namespace

Significance::Significance(const ChanceModel& chance, const Sampler& sampler, int parameters)
    : chance_(chance), sampler_(sampler), parameters_(parameters) {}

void Significance::setSamples(int samples) { logSamples_ = std::log10(samples + 1.); }

Support Significance::support(const Evaluation& evaluation) const {
  return {evaluation.points, sampler_.numberPoints(), evaluation.rays, sampler_.numberRays()};
}

double Significance::logChance(const Evaluation& evaluation, double focalLength) const {
  return chance_.logProbability(support(evaluation), focalLength, parameters_);
}

bool Significance::isPromising(double logChance) const { return logAlarms(logChance) < 0; }

bool Significance::isSignificant(double logChance) const { return logAlarms(logChance) < kLogFalseAlarms; }

bool Significance::isMoreThanChance(const Evaluation& evaluation, double focalLength) const {
  const bool hasPoints = chance_.pointsAreMoreThanChance(evaluation.points, sampler_.numberPoints());
  return logAlarms(logChance(evaluation, focalLength)) < (hasPoints ? kLogFalseAlarms : kLogFalseAlarmsOfRays);
}

// One rig camera's rays do not fix the scale: without those of the camera with most inliers, the rest must still be more than
// chance, with one parameter left to fit.
bool Significance::hasFixedScale(const Evaluation& evaluation, double focalLength, const InlierCounts& inliers) const {
  const std::vector<int>& perCamera = inliers.raysPerCamera;
  const auto largest = std::max_element(perCamera.begin(), perCamera.end());
  if (largest == perCamera.end() || *largest < parameters_ - 1) return true;
  Support rest = support(evaluation);
  rest.rays -= *largest;
  rest.allRays -= sampler_.numberRays(static_cast<std::size_t>(largest - perCamera.begin()));
  return logAlarms(chance_.logProbability(rest, focalLength, 1)) < kLogFalseAlarms;
}

sac::FailureReason Significance::verdict(const Evaluation& evaluation, double focalLength, const InlierCounts& inliers,
                                         bool isRegular) const {
  if (!isMoreThanChance(evaluation, focalLength)) return sac::FailureReason::InliersMayBeChance;
  if (!isRegular || !hasFixedScale(evaluation, focalLength, inliers)) return sac::FailureReason::UndeterminedPose;
  return sac::FailureReason::None;
}

}  // namespace robust
}  // namespace hybridgv
