#include "hybridgv/adapters/sfm/localizeQuery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "CheckArguments.hpp"
#include "QueryCamera.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

void checkOptions(const QueryOptions& options) {
  checkPositive("options.priorDeviation", options.priorDeviation);
  if (options.minInliers < 0)
    throwInvalid("options.minInliers", "must not be negative, is " + std::to_string(options.minInliers));
  if (!(options.minInlierShare >= 0 && options.minInlierShare <= 1))
    throwInvalid("options.minInlierShare", "must be in 0 .. 1, is " + detail::format(options.minInlierShare));
}

double relativeDeviation(const sac::HybridRansacResult& result) {
  return result.success ? result.focalLengthStandardDeviation / result.pose.focalLength : std::numeric_limits<double>::infinity();
}

// A result that hangs on few correspondences (its focal length would be far off without them) may be an optimum beside a better one:
// other samples are tried, and the best determined result is taken.
sac::HybridRansacResult searchWell(const LocalizationProblem& problem, sac::HybridRansacOptions options) {
  constexpr double kDoubtful = 0.05;
  constexpr int kMoreAttempts = 3;
  sac::HybridRansacResult best = hybridRansac(problem.adapter, options);
  const bool isHopeless = best.failureReason == sac::FailureReason::TooFewCorrespondences;
  for (int i = 0; i < kMoreAttempts && !isHopeless && relativeDeviation(best) > kDoubtful; ++i) {
    ++options.seed;
    const sac::HybridRansacResult other = hybridRansac(problem.adapter, options);
    if (relativeDeviation(other) < relativeDeviation(best)) best = other;
  }
  return best;
}

// What is known of the query's camera.
sac::HybridRansacOptions searchOptions(const QueryImage& query, const QueryOptions& options) {
  sac::HybridRansacOptions search = options.ransac;
  search.knownFocalLengthPx.reset();
  search.focalLengthPriorPx.reset();
  search.queryCamera = sac::QueryCamera::Pinhole;
  if (query.knowledge == CameraKnowledge::Known) {
    search.knownFocalLengthPx = focalLength(query.camera);
    search.minFocalLength = 0;
    search.maxFocalLength = std::numeric_limits<double>::infinity();
    return search;
  }
  if (query.knowledge == CameraKnowledge::Prior && !query.camera.parameters.empty()) {
    search.focalLengthPriorPx = focalLength(query.camera);
    search.focalLengthPriorLogDeviation = options.priorDeviation;
  }
  if (!options.estimateDistortion) return search;
  search.queryCamera = sac::QueryCamera::Radial;
  if (search.imageRadiusPx == 0)
    search.imageRadiusPx = std::hypot(static_cast<double>(query.camera.width), static_cast<double>(query.camera.height)) / 2;
  return search;
}

// Empty for a success.
std::string reasonOf(const QueryImage& query, const LocalizationProblem& problem, const sac::HybridRansacResult& result,
                     const QueryOptions& options) {
  const std::size_t rays = problem.adapter.getNumberCorrespondences2d2d(),
                    points = problem.adapter.getNumberCorrespondences2d3d();
  if (query.matches.empty()) return "no matches with the map";
  const std::string matches = " (" + std::to_string(rays) + " 2D-2D and " + std::to_string(points) + " 2D-3D matches)";
  if (result.failureReason == sac::FailureReason::TooFewCorrespondences)
    return (points == 0 ? "no 2D-3D match" : "too few matches") + matches;
  if (!result.success) return toString(result.failureReason) + matches;
  const int inliers = result.numberInliers2d2d + result.numberInliers2d3d;
  if (inliers < options.minInliers)
    return "too few inliers (" + std::to_string(inliers) + ", " + std::to_string(options.minInliers) + " are wanted)";
  const double share = inliers / static_cast<double>(rays + points);
  if (share < options.minInlierShare)
    return "too small a share of inliers (" + detail::format(share) + ", " + detail::format(options.minInlierShare) +
           " is wanted)";
  return {};
}

std::vector<PairReport> reportPairs(const SparseModel& map, const QueryImage& query, const LocalizationProblem& problem,
                                    const sac::HybridRansacResult& result) {
  std::set<std::pair<std::size_t, std::size_t>> rays, points;  // keypoint and image, keypoint and point
  for (std::size_t i = 0; i < result.inliers2d2d.size(); ++i)
    if (result.inliers2d2d[i] != 0)
      rays.emplace(problem.keypoints2d2d[i], problem.rigImages[static_cast<std::size_t>(problem.adapter.getCamIndex(i))]);
  for (std::size_t i = 0; i < result.inliers2d3d.size(); ++i)
    if (result.inliers2d3d[i] != 0) points.emplace(problem.keypoints2d3d[i], problem.points2d3d[i]);
  std::vector<PairReport> reports;
  for (const ImageMatches& matches : query.matches) {
    PairReport report{matches.image, matches.pairs.size(), 0, 0};
    const std::vector<Observation>& observations = map.images[matches.image].observations;
    for (const auto& [keypoint, observation] : matches.pairs) {
      if (observation >= observations.size()) continue;
      if (points.count({keypoint, observations[observation].point}) != 0)
        ++report.inliers2d3d;
      else
        report.inliers2d2d += rays.count({keypoint, matches.image});
    }
    reports.push_back(report);
  }
  return reports;
}

void setCamera(const QueryImage& query, double f, double k1, QueryLocalization& localization) {
  localization.k1 = k1;
  localization.camera = estimatedCamera(query.camera, f, k1);
  localization.distortionIsLost = k1 != 0 && !hasDistortion(query.camera.model);
}

}  // namespace

QueryLocalization localizeQuery(const SparseModel& map, const QueryImage& query, const QueryOptions& options) {
  checkOptions(options);
  QueryLocalization localization{false, {}, makeLocalizationProblem(map, query, options.matches), {}, query.camera, 0, 0,
                                 false, {}};
  const LocalizationProblem& problem = localization.problem;
  localization.result = searchWell(problem, searchOptions(query, options));
  localization.reason = reasonOf(query, problem, localization.result, options);
  localization.success = localization.reason.empty();
  const sac::HybridRansacResult& result = localization.result;
  if (localization.success && query.knowledge != CameraKnowledge::Known) {
    setCamera(query, result.simpleRadialFocalLength, result.simpleRadialK1, localization);
    localization.k1StandardDeviation = result.simpleRadialK1StandardDeviation;
  }
  localization.pairs = reportPairs(map, query, problem, localization.result);
  return localization;
}

namespace {

constexpr double kSmallestDeviation = 2e-3, kMostDeviations = 5;

double weightOf(const CameraEstimate& e) {
  const double deviation = std::max(e.deviation, kSmallestDeviation * e.focalLength);
  return 1 / (deviation * deviation);
}

// Half of the weight is below it.
double middleOf(std::vector<CameraEstimate> estimates) {
  const auto isShorter = [](const CameraEstimate& a, const CameraEstimate& b) { return a.focalLength < b.focalLength; };
  std::sort(estimates.begin(), estimates.end(), isShorter);
  double sum = 0, half = 0;
  for (const CameraEstimate& e : estimates) half += weightOf(e) / 2;
  for (const CameraEstimate& e : estimates) {
    sum += weightOf(e);
    if (sum >= half) return e.focalLength;
  }
  return estimates.back().focalLength;
}

void checkSameCamera(const std::vector<QueryImage>& queries) {
  for (const QueryImage& query : queries) {
    const Camera &a = queries[0].camera, &b = query.camera;
    if (a.model != b.model || a.width != b.width || a.height != b.height || a.parameters != b.parameters ||
        query.knowledge != queries[0].knowledge)
      throwInvalid("queries", query.name + " has another camera than " + queries[0].name);
  }
}

// Does an image know better than the others? (With a wrong focal length it would still find a pose, of a wrong distance.)
bool contradict(const QueryLocalization& alone, const CameraEstimate& common) {
  constexpr double kSmallestDeviation = 0.01;
  if (!alone.success) return false;
  const CameraEstimate own = estimateOf(alone);
  const double deviation = std::max(own.deviation, kSmallestDeviation * own.focalLength);
  return std::abs(own.focalLength - common.focalLength) > kMostDeviations * deviation;
}

// With the common camera; no success if it does not fit.
QueryLocalization localizeKnown(const SparseModel& map, const QueryImage& query, const CameraEstimate& common,
                                const QueryOptions& options) {
  QueryImage known = query;
  known.knowledge = CameraKnowledge::Known;
  known.camera = distortedCamera(query.camera, common.focalLength, common.k1);
  QueryLocalization localization = localizeQuery(map, known, options);
  setCamera(query, common.focalLength, common.k1, localization);
  return localization;
}

}  // namespace

CameraEstimate estimateOf(const QueryLocalization& localization) {
  return {focalLength(localization.camera), localization.result.focalLengthStandardDeviation, localization.k1};
}

std::optional<CameraEstimate> agree(const std::vector<CameraEstimate>& estimates) {
  for (const CameraEstimate& e : estimates)
    if (!(e.focalLength > 0) || !std::isfinite(e.focalLength) || !std::isfinite(e.k1) || !(e.deviation >= 0))
      throwInvalid("estimates", "one has the focal length " + detail::format(e.focalLength) + ", the deviation " +
                                    detail::format(e.deviation) + " and k1 " + detail::format(e.k1));
  if (estimates.empty()) return std::nullopt;
  const double middle = middleOf(estimates);
  double sum = 0;
  CameraEstimate mean;
  for (const CameraEstimate& e : estimates) {
    const double weight = weightOf(e);
    if (std::abs(e.focalLength - middle) * std::sqrt(weight) > kMostDeviations) continue;
    sum += weight;
    mean.focalLength += weight * e.focalLength;
    mean.k1 += weight * e.k1;
  }
  return CameraEstimate{mean.focalLength / sum, 1 / std::sqrt(sum), mean.k1 / sum};
}

QueryLocalization localizeQuery(const SparseModel& map, const QueryImage& query, const CameraEstimate& common,
                                const QueryOptions& options) {
  QueryLocalization alone = localizeQuery(map, query, options);
  if (query.knowledge == CameraKnowledge::Known || contradict(alone, common)) return alone;
  QueryLocalization known = localizeKnown(map, query, common, options);
  return known.success ? known : alone;
}

std::vector<QueryLocalization> localizeQueries(const SparseModel& map, const std::vector<QueryImage>& queries,
                                               const QueryOptions& options) {
  checkSameCamera(queries);
  std::vector<QueryLocalization> localizations;
  std::vector<CameraEstimate> estimates;
  for (const QueryImage& query : queries) {
    localizations.push_back(localizeQuery(map, query, options));
    if (localizations.back().success) estimates.push_back(estimateOf(localizations.back()));
  }
  if (queries.size() < 2 || queries[0].knowledge == CameraKnowledge::Known) return localizations;
  const std::optional<CameraEstimate> common = agree(estimates);
  if (!common) return localizations;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (contradict(localizations[i], *common)) continue;
    QueryLocalization known = localizeKnown(map, queries[i], *common, options);
    if (known.success) localizations[i] = std::move(known);
  }
  return localizations;
}

}  // namespace sfm
}  // namespace hybridgv
