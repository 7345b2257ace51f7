#include "hybridgv/adapters/sfm/localizeQuery.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "CheckArguments.hpp"
#include "QueryCamera.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

void checkOptions(const QueryOptions& options) {
  checkNotNegative("options.priorDeviation", options.priorDeviation);
  if (options.minInliers < 0)
    throwInvalid("options.minInliers", "must not be negative, is " + std::to_string(options.minInliers));
  if (!(options.minInlierShare >= 0 && options.minInlierShare <= 1))
    throwInvalid("options.minInlierShare", "must be in 0 .. 1, is " + detail::format(options.minInlierShare));
}

// The options with the focal length between the two.
sac::HybridRansacOptions within(sac::HybridRansacOptions options, double smallest, double largest) {
  options.minFocalLength = std::max(options.minFocalLength, smallest);
  options.maxFocalLength = std::min(options.maxFocalLength, largest);
  return options;
}

bool isRangeEmpty(const sac::HybridRansacOptions& options) { return !(options.minFocalLength < options.maxFocalLength); }

sac::HybridRansacResult searchNear(const LocalizationProblem& problem, double f, double factor, const QueryOptions& options) {
  const sac::HybridRansacOptions narrow = within(options.ransac, f / factor, f * factor);
  return isRangeEmpty(narrow) ? sac::HybridRansacResult() : hybridRansac(problem.adapter, narrow);
}

sac::HybridRansacResult search(const LocalizationProblem& problem, const QueryImage& query, const QueryOptions& options) {
  constexpr double kKnown = 1 + 1e-3;
  if (query.knowledge == CameraKnowledge::Known) return searchNear(problem, focalLength(query.camera), kKnown, options);
  if (query.knowledge == CameraKnowledge::Prior && !query.camera.parameters.empty()) {
    const double factor = 1 + 3 * options.priorDeviation;
    const sac::HybridRansacResult result = searchNear(problem, focalLength(query.camera), factor, options);
    if (result.success) return result;
  }
  return hybridRansac(problem.adapter, options.ransac);
}

std::string counted(std::size_t count, const char* kind) { return std::to_string(count) + " " + kind; }

// Empty for a success.
std::string reasonOf(const QueryImage& query, const LocalizationProblem& problem, const sac::HybridRansacResult& result,
                     const QueryOptions& options) {
  const std::size_t rays = problem.adapter.getNumberCorrespondences2d2d(),
                    points = problem.adapter.getNumberCorrespondences2d3d();
  if (query.matches.empty()) return "no matches with the map";
  const std::string matches = counted(rays, "2D-2D and ") + counted(points, "2D-3D matches");
  if (result.failureReason == sac::FailureReason::TooFewCorrespondences)
    return points == 0 ? "no 2D-3D match, of " + matches : "too few: " + matches;
  if (!result.success) return std::string(toString(result.failureReason)) + " (" + matches + ")";
  const int inliers = result.numberInliers2d2d + result.numberInliers2d3d;
  if (inliers < options.minInliers)
    return "only " + std::to_string(inliers) + " inliers, " + std::to_string(options.minInliers) + " are wanted";
  const double share = inliers / static_cast<double>(rays + points);
  if (share < options.minInlierShare)
    return "only " + detail::format(100 * share) + " % of the matches are inliers, " +
           detail::format(100 * options.minInlierShare) + " % are wanted";
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
  QueryLocalization localization{false, {}, makeLocalizationProblem(map, query, options.matches), {}, query.camera, 0, false, {}};
  const LocalizationProblem& problem = localization.problem;
  localization.result = search(problem, query, options);
  localization.reason = reasonOf(query, problem, localization.result, options);
  localization.success = localization.reason.empty();
  if (localization.success && query.knowledge != CameraKnowledge::Known)
    setCamera(query, localization.result.pose.focalLength, 0, localization);
  localization.pairs = reportPairs(map, query, problem, localization.result);
  return localization;
}

namespace {

// What the images of one camera say about it.
struct JointCamera {
  bool isFound = false;
  double focalLength = 0, k1 = 0;
};

struct Opinion {
  double focalLength, deviation, k1;
  double weight() const { return 1 / (deviation * deviation); }
};

double weightedMedian(std::vector<Opinion> opinions) {
  std::sort(opinions.begin(), opinions.end(), [](const Opinion& a, const Opinion& b) { return a.focalLength < b.focalLength; });
  double sum = 0, half = 0;
  for (const Opinion& o : opinions) half += o.weight() / 2;
  for (const Opinion& o : opinions) {
    sum += o.weight();
    if (sum >= half) return o.focalLength;
  }
  return opinions.back().focalLength;
}

JointCamera agree(const std::vector<QueryLocalization>& localizations) {
  // Deviations say nothing of errors that all matches of an image share.
  constexpr double kSmallestDeviation = 2e-3, kMostDeviations = 5;
  std::vector<Opinion> opinions;
  for (const QueryLocalization& l : localizations) {
    if (!l.success) continue;
    const double f = l.camera.parameters[0];
    opinions.push_back({f, std::max(l.result.focalLengthStandardDeviation, kSmallestDeviation * f), l.k1});
  }
  JointCamera joint;
  if (opinions.empty()) return joint;
  const double middle = weightedMedian(opinions);
  double sum = 0;
  for (const Opinion& o : opinions) {
    if (std::abs(o.focalLength - middle) > kMostDeviations * o.deviation) continue;
    sum += o.weight();
    joint.focalLength += o.weight() * o.focalLength;
    joint.k1 += o.weight() * o.k1;
  }
  joint.isFound = sum > 0;
  joint.focalLength /= sum;
  joint.k1 /= sum;
  return joint;
}

void checkSameCamera(const std::vector<QueryImage>& queries) {
  for (const QueryImage& query : queries) {
    const Camera &a = queries[0].camera, &b = query.camera;
    if (a.model != b.model || a.width != b.width || a.height != b.height || a.parameters != b.parameters ||
        query.knowledge != queries[0].knowledge)
      throwInvalid("queries", query.name + " has another camera than " + queries[0].name);
  }
}

}  // namespace

std::vector<QueryLocalization> localizeQueries(const SparseModel& map, const std::vector<QueryImage>& queries,
                                               const QueryOptions& options) {
  checkSameCamera(queries);
  std::vector<QueryLocalization> localizations;
  for (const QueryImage& query : queries) localizations.push_back(localizeQuery(map, query, options));
  if (queries.size() < 2 || queries[0].knowledge == CameraKnowledge::Known) return localizations;
  const JointCamera joint = agree(localizations);
  if (!joint.isFound) return localizations;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    QueryImage query = queries[i];
    query.knowledge = CameraKnowledge::Known;
    query.camera = distortedCamera(queries[i].camera, joint.focalLength, joint.k1);
    QueryLocalization known = localizeQuery(map, query, options);
    if (!known.success && localizations[i].success) continue;
    if (known.success)
      setCamera(queries[i], joint.focalLength, joint.k1, known);
    else
      known.camera = queries[i].camera;
    localizations[i] = std::move(known);
  }
  return localizations;
}

}  // namespace sfm
}  // namespace hybridgv
