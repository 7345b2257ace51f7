#include "robust/PoseScorer.hpp"

#include <algorithm>
#include <cmath>

#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

constexpr std::size_t kChunk = 64;

// The log of the likelihood ratio of two shares of inliers, per inlier and per outlier.
struct LogRatio {
  LogRatio(double good, double chance) {
    if (!(good > chance)) return;
    perInlier = std::log(good / chance);
    perOutlier = std::log((1 - good) / (1 - chance));
  }
  double of(int inliers, std::size_t count) const {
    return inliers * perInlier + (static_cast<double>(count) - inliers) * perOutlier;
  }

  double perInlier = 0, perOutlier = 0;
};

// Wald's sequential probability ratio test of the inlier share of each kind.
class SequentialTest {
 public:
  explicit SequentialTest(const Expectation& expectation)
      : rays_(expectation.goodShare.rays, expectation.chanceShare.rays),
        points_(expectation.goodShare.points, expectation.chanceShare.points) {}
  void add(bool isRays, int inliers, std::size_t count) { ratio_ += (isRays ? rays_ : points_).of(inliers, count); }
  bool isHopeless() const { return ratio_ < kReject; }

 private:
  static constexpr double kReject = -4.605170185988091;  // log(kFalseRejection)
  LogRatio rays_, points_;
  double ratio_ = 0;  // of good : chance
};

}  // namespace

PoseScorer::PoseScorer(const CorrespondenceArrays& arrays, const PerKind<double>& bounds, sac::Scoring scoring)
    : arrays_(arrays),
      points_(arrays.pointArrays()),
      rays_(arrays.rayArrays()),
      bounds_(bounds),
      thresholds_(bounds),
      scoring_(scoring) {
  makeChunks();
}

// Chunks of the two kinds by turns.
void PoseScorer::makeChunks() {
  for (std::size_t begin = 0; begin < std::max(points_.size, rays_.size); begin += kChunk) {
    if (begin < points_.size) chunks_.push_back({false, begin, std::min(begin + kChunk, points_.size)});
    if (begin < rays_.size) chunks_.push_back({true, begin, std::min(begin + kChunk, rays_.size)});
  }
}

int PoseScorer::add(const Chunk& chunk, const Kernels& kernels, const PlainPose& pose, Evaluation& evaluation) const {
  const double threshold = chunk.isRays ? thresholds_.rays : thresholds_.points;
  const Score part = chunk.isRays ? kernels.scoreRays(rays_, pose, threshold * threshold, chunk.begin, chunk.end)
                                  : kernels.scorePoints(points_, pose, threshold * threshold, chunk.begin, chunk.end);
  evaluation.score += scoring_ == sac::Scoring::Msac ? part.msac : part.inliers;
  (chunk.isRays ? evaluation.rays : evaluation.points) += part.inliers;
  return part.inliers;
}

Evaluation PoseScorer::evaluate(const QueryPose& pose) const {
  const PlainPose plain = toPlain(pose);
  const Kernels& kernels = kernelsFor(plain);
  Evaluation result;
  for (const Chunk& chunk : chunks_) add(chunk, kernels, plain, result);
  result.complete = true;
  result.scale = scale();
  return result;
}

Evaluation PoseScorer::evaluate(const QueryPose& pose, const Expectation& expectation) const {
  const PlainPose plain = toPlain(pose);
  const Kernels& kernels = kernelsFor(plain);
  SequentialTest test(expectation);
  Evaluation result;
  result.scale = scale();
  std::size_t left = points_.size + rays_.size;
  for (const Chunk& chunk : chunks_) {
    const std::size_t count = chunk.end - chunk.begin;
    test.add(chunk.isRays, add(chunk, kernels, plain, result), count);
    left -= count;
    if (result.score + static_cast<double>(left) <= expectation.score || test.isHopeless()) return result;
  }
  result.complete = true;
  return result;
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
  result.score = scoreOf(errors.rays, thresholdAt(bounds_.rays, ray), result.rays) +
                 scoreOf(errors.points, thresholdAt(bounds_.points, point), result.points);
  return result;
}

std::vector<double> PoseScorer::squaredRayErrors(const QueryPose& pose) const {
  std::vector<double> errors(rays_.size + correspondences::kPadding);
  const PlainPose plain = toPlain(pose);
  kernelsFor(plain).squaredRayErrors(rays_, plain, errors.data());
  errors.resize(rays_.size);
  return errors;
}

std::vector<double> PoseScorer::squaredPointErrors(const QueryPose& pose) const {
  std::vector<double> errors(points_.size + correspondences::kPadding);
  const PlainPose plain = toPlain(pose);
  kernelsFor(plain).squaredPointErrors(points_, plain, errors.data());
  errors.resize(points_.size);
  return errors;
}

PerKind<std::vector<char>> PoseScorer::inliers(const QueryPose& pose) const {
  const auto below = [](const std::vector<double>& errors, double threshold) {
    std::vector<char> mask(errors.size());
    std::transform(errors.begin(), errors.end(), mask.begin(), [&](double e) { return e < threshold * threshold; });
    return mask;
  };
  return {below(squaredRayErrors(pose), thresholds_.rays), below(squaredPointErrors(pose), thresholds_.points)};
}

}  // namespace robust
}  // namespace hybridgv
