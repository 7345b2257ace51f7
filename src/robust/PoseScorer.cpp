#include "robust/PoseScorer.hpp"

#include <algorithm>
#include <cmath>

#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

constexpr std::size_t kChunk = 64;

// Of one kind, by one of the kernels for that.
template <class Arrays, class Errors>
std::vector<double> errorsOf(const Arrays& arrays, const QueryPose& pose, Errors squaredErrors) {
  std::vector<double> errors(arrays.size + correspondences::kPadding);
  const PlainPose plain = toPlain(pose);
  (kernelsFor(plain).*squaredErrors)(arrays, plain, errors.data());
  errors.resize(arrays.size);
  return errors;
}

// Wald's sequential probability ratio test of the inlier share of each kind, and the bound of the score.
class SequentialTest {
 public:
  SequentialTest(const Expectation& expectation, const OwnCorrespondences& own, std::size_t all)
      : expected_(expectation), own_(own), left_(all) {}

  bool raysTellMore() const { return expected_.rays.perOutlier < expected_.points.perOutlier; }

  void add(bool isRays, std::size_t begin, std::size_t end, int inliers) {
    const int own = isRays ? countIn(own_.indices.rays, own_.count.rays, begin, end)
                           : countIn(own_.indices.points, own_.count.points, begin, end);
    left_ -= end - begin;
    ratio_ += (isRays ? expected_.rays : expected_.points).of(std::max(inliers - own, 0), static_cast<int>(end - begin) - own);
  }
  bool isHopeless(double score) const { return ratio_ < kReject || score + static_cast<double>(left_) <= expected_.score; }

 private:
  static constexpr double kReject = -2.302585092994046;  // log(kFalseRejection)

  static int countIn(const int* indices, int count, std::size_t begin, std::size_t end) {
    return static_cast<int>(std::count_if(indices, indices + count, [=](int index) {
      return static_cast<std::size_t>(index) >= begin && static_cast<std::size_t>(index) < end;
    }));
  }

  const Expectation& expected_;
  const OwnCorrespondences& own_;
  std::size_t left_;
  double ratio_ = 0;  // of good : chance
};

// Everything counts.
class NoTest {
 public:
  static void add(bool /*isRays*/, std::size_t /*begin*/, std::size_t /*end*/, int /*inliers*/) {}
  static bool isHopeless(double /*score*/) { return false; }
};

}  // namespace

LogRatio::LogRatio(double good, double chance) {
  if (!(good > chance)) return;
  perInlier = std::log(good / chance);
  perOutlier = std::log((1 - good) / (1 - chance));
}

PoseScorer::PoseScorer(const CorrespondenceArrays& arrays, const PerKind<double>& bounds, sac::Scoring scoring)
    : arrays_(arrays),
      points_(arrays.pointArrays()),
      rays_(arrays.rayArrays()),
      bounds_(bounds),
      thresholds_(bounds),
      scoring_(scoring),
      chunks_{makeChunks(true, rays_.size), makeChunks(false, points_.size)} {}

std::vector<PoseScorer::Chunk> PoseScorer::makeChunks(bool isRays, std::size_t size) {
  std::vector<Chunk> result;
  for (std::size_t begin = 0; begin < size; begin += kChunk) result.push_back({isRays, begin, std::min(begin + kChunk, size)});
  return result;
}

template <class Test>
bool PoseScorer::addAll(const std::vector<Chunk>& chunks, double threshold, const PlainPose& pose, Test& test,
                        Evaluation& evaluation) const {
  const Kernels& kernels = kernelsFor(pose);
  for (const Chunk& chunk : chunks) {
    const Score part = chunk.isRays ? kernels.scoreRays(rays_, pose, threshold * threshold, chunk.begin, chunk.end)
                                    : kernels.scorePoints(points_, pose, threshold * threshold, chunk.begin, chunk.end);
    evaluation.score += scoring_ == sac::Scoring::Msac ? part.msac : part.inliers;
    (chunk.isRays ? evaluation.rays : evaluation.points) += part.inliers;
    test.add(chunk.isRays, chunk.begin, chunk.end, part.inliers);
    if (test.isHopeless(evaluation.score)) return false;
  }
  return true;
}

Evaluation PoseScorer::evaluate(const QueryPose& pose) const {
  const PlainPose plain = toPlain(pose);
  Evaluation result, ofRays;
  NoTest test;
  both(
      workers_, [&] { addAll(chunks_.rays, thresholds_.rays, plain, test, ofRays); },
      [&] { addAll(chunks_.points, thresholds_.points, plain, test, result); });
  result.score += ofRays.score;
  result.rays = ofRays.rays;
  result.complete = true;
  result.scale = scale();
  return result;
}

Evaluation PoseScorer::evaluate(const QueryPose& pose, const Expectation& expectation, const OwnCorrespondences& own) const {
  const PlainPose plain = toPlain(pose);
  SequentialTest test(expectation, own, points_.size + rays_.size);
  Evaluation result;
  const auto add = [&](bool isRays) {
    return isRays ? addAll(chunks_.rays, thresholds_.rays, plain, test, result)
                  : addAll(chunks_.points, thresholds_.points, plain, test, result);
  };
  const bool raysFirst = test.raysTellMore();
  result.complete = add(raysFirst) && add(!raysFirst);
  result.scale = scale();
  return result;
}

bool PoseScorer::pointsLeaveHope(const QueryPose& pose, double scale, const Expectation& expectation,
                                 const OwnCorrespondences& own) const {
  SequentialTest test(expectation, own, points_.size + rays_.size);
  Evaluation unused;
  return addAll(chunks_.points, scale * bounds_.points, toPlain(pose), test, unused);
}

void PoseScorer::computeErrors(const QueryPose& pose, PerKind<std::vector<double>>& errors) const {
  const PlainPose plain = toPlain(pose);
  errors.rays.resize(rays_.size + correspondences::kPadding);
  errors.points.resize(points_.size + correspondences::kPadding);
  kernelsFor(plain).squaredRayErrors(rays_, plain, errors.rays.data());
  kernelsFor(plain).squaredPointErrors(points_, plain, errors.points.data());
  errors.rays.resize(rays_.size);
  errors.points.resize(points_.size);
}

double PoseScorer::scoreOf(const std::vector<double>& squaredErrors, double threshold, int inliers) const {
  if (scoring_ == sac::Scoring::InlierCount) return inliers;
  const double squared = threshold * threshold;
  double sum = 0;
  for (const double e : squaredErrors) sum += e < squared ? 1 - e / squared : 0;
  return sum;
}

Evaluation PoseScorer::evaluateAtClearestLevels(const QueryPose& pose, const Shares& chance,
                                                PerKind<std::vector<double>>& errors) const {
  // What is in a sample agrees by construction.
  constexpr int kFittedRays = 4, kFittedPoints = 2;
  computeErrors(pose, errors);
  const LevelCounts rays = countLevels(errors.rays.data(), rays_.size, bounds_.rays * bounds_.rays);
  const LevelCounts points = countLevels(errors.points.data(), points_.size, bounds_.points * bounds_.points);
  const int ray = clearestLevel(rays, rays_.size, chance.rays, kFittedRays);
  const int point = clearestLevel(points, points_.size, chance.points, kFittedPoints);
  Evaluation result;
  result.complete = true;
  result.rays = rays[static_cast<std::size_t>(ray)];
  result.points = points[static_cast<std::size_t>(point)];
  result.scale = {thresholdAt(1, ray), thresholdAt(1, point)};
  return result;
}

double PoseScorer::score(const Evaluation& evaluation, const PerKind<std::vector<double>>& errors) const {
  return scoreOf(errors.rays, evaluation.scale.rays * bounds_.rays, evaluation.rays) +
         scoreOf(errors.points, evaluation.scale.points * bounds_.points, evaluation.points);
}

std::vector<double> PoseScorer::squaredRayErrors(const QueryPose& pose) const {
  return errorsOf(rays_, pose, &Kernels::squaredRayErrors);
}

std::vector<double> PoseScorer::squaredRayErrorsBeyondInfinity(const QueryPose& pose) const {
  return errorsOf(rays_, pose, &Kernels::squaredRayErrorsBeyondInfinity);
}

std::vector<double> PoseScorer::squaredPointErrors(const QueryPose& pose) const {
  return errorsOf(points_, pose, &Kernels::squaredPointErrors);
}

PerKind<std::vector<char>> PoseScorer::inliers(const QueryPose& pose, double factor) const {
  return within({std::min(factor * thresholds_.rays, bounds_.rays), std::min(factor * thresholds_.points, bounds_.points)}, pose);
}

PerKind<std::vector<char>> PoseScorer::within(const PerKind<double>& thresholds, const QueryPose& pose) const {
  const auto below = [](const std::vector<double>& errors, double threshold) {
    std::vector<char> mask(errors.size());
    std::transform(errors.begin(), errors.end(), mask.begin(), [&](double e) { return e < threshold * threshold; });
    return mask;
  };
  PerKind<std::vector<char>> masks;
  both(
      workers_, [&] { masks.rays = below(squaredRayErrors(pose), thresholds.rays); },
      [&] { masks.points = below(squaredPointErrors(pose), thresholds.points); });
  return masks;
}

}  // namespace robust
}  // namespace hybridgv
