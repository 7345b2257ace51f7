#include "robust/HybridSearch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "CheckArguments.hpp"
#include "robust/SampleCheck.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Batches grow, because what was learnt from one steers the next: to 128 samples, then with a quarter of all before.
constexpr int kFirstBatch = 16, kLargestBatch = 128, kLargestPart = 4;

int largestBatch(int iterations) { return std::max(kLargestBatch, iterations / kLargestPart); }

// Streams of random numbers apart from those of the hypotheses.
constexpr std::uint64_t kRayOrderStream = ~std::uint64_t{0}, kPointOrderStream = kRayOrderStream - 1;
// log10 of the expected number of wrong poses that look like the result.
constexpr double kLogFalseAlarms = -6;
// The same without points. A part of the rays can agree with a pose near the right one much better than with one that is wrong in
// every way, and up to half of them are inliers there.
constexpr double kLogFalseAlarmsOfRays = -25;
// Gain of the log-likelihood for which an optimization is repeated.
constexpr double kLeastGain = 1;
constexpr double kDistanceFactors[] = {1.25, 1.6, 0.8, 0.6};
// A pose from a minimal sample has less inliers than its optimum: the share of them that is tested for.
constexpr double kUnoptimizedShare = 0.5;

// The indices 0 .. count-1 in random order.
std::vector<int> shuffled(std::size_t count, std::uint64_t seed, std::uint64_t stream) {
  std::vector<int> order = correspondences::allIndices(count);
  RandomStream random(seed, stream);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return order;
}

// Positions in the arrays in order of decreasing weight; equal weights stay in their random order.
template <class Weight>
std::vector<int> byQuality(const char* name, const std::vector<int>& indices, Weight weight) {
  std::vector<int> order = correspondences::allIndices(indices.size());
  const auto weightOf = [&](int i) { return weight(static_cast<std::size_t>(indices[static_cast<std::size_t>(i)])); };
  for (const int i : order)
    if (!std::isfinite(weightOf(i)))
      throwInvalid("adapter." + std::string(name) + "(" + std::to_string(indices[static_cast<std::size_t>(i)]) + ")",
                   "must be finite, is " + std::to_string(weightOf(i)));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return weightOf(a) > weightOf(b); });
  return order;
}

Sampler makeSampler(const hybrid_pose::HybridAdapterBase& adapter, const CorrespondenceArrays& arrays,
                    const std::vector<int>& rayIndices, const std::vector<int>& pointIndices, sac::Sampling sampling) {
  std::vector<int> cameras;
  for (const correspondences::RayMatch& ray : arrays.rays()) cameras.push_back(ray.camera);
  if (sampling == sac::Sampling::Uniform)
    return {cameras, correspondences::allIndices(rayIndices.size()), correspondences::allIndices(pointIndices.size()), false};
  std::vector<int> rays = byQuality("getWeight2d2d", rayIndices, [&](std::size_t i) { return adapter.getWeight2d2d(i); });
  std::vector<int> points = byQuality("getWeight2d3d", pointIndices, [&](std::size_t i) { return adapter.getWeight2d3d(i); });
  const bool weightsDiffer = !std::is_sorted(rays.begin(), rays.end()) || !std::is_sorted(points.begin(), points.end());
  return {cameras, std::move(rays), std::move(points), weightsDiffer};
}

CorrespondenceArrays readArrays(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& rays,
                                const std::vector<int>& points) {
  CorrespondenceArrays arrays(adapter, rays, points);
  arrays.boundUnknownFocalLengths();
  return arrays;
}

}  // namespace

HybridSearch::HybridSearch(const hybrid_pose::HybridAdapterBase& adapter, const sac::HybridRansacOptions& options,
                           Clock::time_point start)
    : options_(options),
      start_(start),
      rayIndices_(shuffled(adapter.getNumberCorrespondences2d2d(), options.seed, kRayOrderStream)),
      pointIndices_(shuffled(adapter.getNumberCorrespondences2d3d(), options.seed, kPointOrderStream)),
      arrays_(readArrays(adapter, rayIndices_, pointIndices_)),
      sampler_(makeSampler(adapter, arrays_, rayIndices_, pointIndices_, options.sampling)),
      choice_(makeStrategies(options.solvers, sampler_)),
      scorer_(arrays_, options.maxEpipolarErrorPx, options.maxReprojectionErrorPx, options.scoring),
      chance_(arrays_, options.maxEpipolarErrorPx, options.maxReprojectionErrorPx),
      optimizer_(scorer_, chance_, options.minFocalLength, options.maxFocalLength),
      workers_(numberOfWorkers(options.threads, std::min(options.maxIterations, largestBatch(options.maxIterations)))),
      workerStates_(workers_.size()) {
  for (WorkerState& worker : workerStates_) worker.draws.resize(choice_.strategies().size());
}

void HybridSearch::run() {
  if (options_.initialPose) tryInitialPose();
  if (choice_.strategies().empty()) return;
  for (int batch = kFirstBatch; !isDone(); batch = std::min(2 * batch, largestBatch(iterations_)))
    tryBatch(std::min(batch, options_.maxIterations - iterations_));
}

void HybridSearch::tryInitialPose() {
  Model model;
  model.pose = arrays_.normalization().apply(*options_.initialPose);
  model.evaluation = scorer_.evaluate(model.pose);
  if (model.evaluation.score > 0) consider(model);
}

void HybridSearch::tryBatch(int count) {
  for (WorkerState& worker : workerStates_) {
    std::fill(worker.draws.begin(), worker.draws.end(), 0);
    worker.best.reset();
  }
  workers_.forEach(count, [&](int i, std::size_t worker) {
    if (!isOutOfTime()) tryHypothesis(iterations_ + i + 1, workerStates_[worker]);
  });
  std::optional<Candidate> best;
  for (const WorkerState& worker : workerStates_) {
    iterations_ += std::accumulate(worker.draws.begin(), worker.draws.end(), 0);
    for (std::size_t s = 0; s < worker.draws.size(); ++s) choice_.addDraws(s, worker.draws[s]);
    if (worker.best && (!best || worker.best->isLessLikelyChance(*best))) best = worker.best;
  }
  if (best && isWorthConsidering(*best)) consider(best->model);
}

// Of minimal solutions the one is best that is least likely chance. Their scores do not tell, because an inlier of one kind can
// be much less of an accident than one of the other.
bool HybridSearch::Candidate::isLessLikelyChance(const Candidate& other) const {
  if (logChance != other.logChance) return logChance < other.logChance;
  if (model.evaluation.score != other.model.evaluation.score) return model.evaluation.score > other.model.evaluation.score;
  return number < other.number;
}

// If less than one wrong pose of those tried so far is expected to look as good; or if it is the best so far, as long as no
// better one is known.
bool HybridSearch::isWorthConsidering(const Candidate& candidate) {
  if (candidate.logChance + logTests() < 0) return true;
  if (bestIsSignificant_ || (bestCandidate_ && !candidate.isLessLikelyChance(*bestCandidate_))) return false;
  bestCandidate_ = candidate;
  return true;
}

void HybridSearch::tryHypothesis(int number, WorkerState& worker) const {
  RandomStream random(options_.seed, static_cast<std::uint64_t>(number));
  const std::size_t chosen = choice_.choose(random.uniform());
  ++worker.draws[chosen];
  const Strategy& strategy = choice_.strategies()[chosen];
  const Sample sample = sampler_.draw(strategy.size, number, random);

  correspondences::RayMatch rays[kMaxSampleSize];
  correspondences::PointMatch points[kMaxSampleSize];
  for (int k = 0; k < strategy.size.rays; ++k) rays[k] = arrays_.rays()[static_cast<std::size_t>(sample.rays[k])];
  for (int k = 0; k < strategy.size.points; ++k) points[k] = arrays_.points()[static_cast<std::size_t>(sample.points[k])];
  if (isDegenerate(rays, strategy.size.rays, points, strategy.size.points)) return;

  const int found = strategy.solve(rays, points, worker.solutions.data());
  for (int k = 0; k < found; ++k)
    considerSolution(worker.solutions[static_cast<std::size_t>(k)], strategy.solver, number, worker.best);
}

void HybridSearch::considerSolution(const FocalPose& pose, Solver solver, int number, std::optional<Candidate>& best) const {
  if (!(pose.focalLength >= options_.minFocalLength && pose.focalLength <= options_.maxFocalLength)) return;
  Candidate candidate;
  candidate.number = number;
  candidate.model.solver = solver;
  candidate.model.pose = pose;
  candidate.model.evaluation = scorer_.evaluate(pose, expectation_);
  if (!candidate.model.evaluation.complete) return;
  candidate.logChance = logChance(candidate.model);
  if (!best || candidate.isLessLikelyChance(*best)) best = candidate;
}

void HybridSearch::consider(const Model& candidate) {
  Model optimized = candidate;
  if (options_.localOptimization) {
    optimized.logLikelihood = optimizer_.logLikelihood(candidate.pose);
    ++localOptimizations_;
    replaceIfLikelier(optimizer_.refine(candidate.pose), optimized);
  }
  if (isBetter(optimized)) setBest(optimized);
}

// A pose that is more than chance is better than one that is not; of optimized ones the likelier, otherwise the score decides.
bool HybridSearch::isBetter(const Model& model) const {
  if (isSignificant(model) != bestIsSignificant_) return !bestIsSignificant_;
  if (options_.localOptimization && hasModel()) return model.logLikelihood > best_.logLikelihood;
  return model.evaluation.score > best_.evaluation.score;
}

void HybridSearch::replaceIfLikelier(const FocalPose& pose, Model& model) const {
  const double logLikelihood = optimizer_.logLikelihood(pose);
  if (!(logLikelihood > model.logLikelihood)) return;
  model.pose = pose;
  model.logLikelihood = logLikelihood;
  model.evaluation = scorer_.evaluate(pose);
}

// Distance and focal length have almost the same effect on the images, so that the likelihood has local optima along both. The
// right one is found from nearer or farther away, the focal length keeping the images' size.
void HybridSearch::escapeLocalOptimum(Model& model) const {
  model.logLikelihood = optimizer_.logLikelihood(model.pose);
  for (const double factor : kDistanceFactors)
    for (double before = -std::numeric_limits<double>::infinity(); model.logLikelihood > before + kLeastGain;) {
      before = model.logLikelihood;
      const Kinds kinds = optimizer_.moreThanChance(model.pose);
      replaceIfLikelier(optimizer_.settle(optimizer_.atDistance(model.pose, factor), kinds), model);
    }
}

void HybridSearch::setBest(const Model& model) {
  best_ = model;
  bestIsSignificant_ = isSignificant(model);
  if (!bestIsSignificant_) return;
  std::vector<char> rays, points;
  scorer_.inliers(model.pose, rays, points);
  const InlierCounts inliers = sampler_.count(rays, points);
  std::vector<double> probabilities;
  for (const Strategy& strategy : choice_.strategies())
    probabilities.push_back((1 - kFalseRejection) * sampler_.allInlierProbability(strategy.size, inliers));
  choice_.setAllInlierProbabilities(probabilities);

  const auto share = [](int part, int all) { return all > 0 ? std::min(kUnoptimizedShare * part / all, 0.9) : 0; };
  expectation_.goodShare[0] = share(inliers.rays, sampler_.numberRays());
  expectation_.goodShare[1] = share(inliers.points, sampler_.numberPoints());
  expectation_.chanceShare[0] = chance_.rayShare(model.pose.focalLength), expectation_.chanceShare[1] = chance_.pointShare();
}

Support HybridSearch::support(const Evaluation& evaluation) const {
  return {evaluation.points, sampler_.numberPoints(), evaluation.rays, sampler_.numberRays()};
}

double HybridSearch::logChance(const Model& model) const {
  return chance_.logProbability(support(model.evaluation), model.pose.focalLength, kParameters);
}

double HybridSearch::logTests() const { return std::log10(iterations_ + 1.); }

bool HybridSearch::isSignificant(const Model& model) const { return logChance(model) + logTests() < kLogFalseAlarms; }

bool HybridSearch::isOutOfTime() const {
  return std::isfinite(options_.timeBudgetSeconds) &&
         std::chrono::duration<double>(Clock::now() - start_).count() > options_.timeBudgetSeconds;
}

bool HybridSearch::isDone() {
  if (isOutOfTime()) {
    stopReason_ = sac::StopReason::TimeBudget;
  } else if (iterations_ >= options_.maxIterations) {
    stopReason_ = sac::StopReason::MaxIterations;
  } else if (bestIsSignificant_ && iterations_ >= options_.minIterations &&
             choice_.missProbability() < 1 - options_.successProbability) {
    stopReason_ = sac::StopReason::Confident;
  }
  return stopReason_ != sac::StopReason::NotStarted;
}

FinalPose HybridSearch::finish(bool optimize) {
  if (optimize) escapeLocalOptimum(best_);
  FinalPose result = optimizer_.polish(best_.pose, optimize);
  best_.pose = result.pose;
  best_.evaluation = scorer_.evaluate(best_.pose);
  return result;
}

// One rig camera's rays do not fix the scale: without those of the camera with most inliers, the rest must still be more than
// chance, with one parameter left to fit.
sac::FailureReason HybridSearch::verify(bool isRegular) const {
  const bool hasPoints = chance_.pointsAreMoreThanChance(best_.evaluation.points, sampler_.numberPoints());
  if (!(logChance(best_) + logTests() < (hasPoints ? kLogFalseAlarms : kLogFalseAlarmsOfRays)))
    return sac::FailureReason::InliersMayBeChance;
  std::vector<char> rays, points;
  scorer_.inliers(best_.pose, rays, points);
  const std::vector<int> perCamera = sampler_.count(rays, points).raysPerCamera;
  const auto largest = std::max_element(perCamera.begin(), perCamera.end());
  if (largest != perCamera.end() && *largest >= kParameters - 1) {
    Support rest = support(best_.evaluation);
    rest.rays -= *largest;
    rest.allRays -= sampler_.numberRays(static_cast<std::size_t>(largest - perCamera.begin()));
    if (!(chance_.logProbability(rest, best_.pose.focalLength, 1) + logTests() < kLogFalseAlarms))
      return sac::FailureReason::UndeterminedPose;
  }
  return isRegular ? sac::FailureReason::None : sac::FailureReason::UndeterminedPose;
}

}  // namespace robust
}  // namespace hybridgv
