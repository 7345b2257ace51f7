#include "robust/PoseScorer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

constexpr std::size_t kChunk = 64;

// Wald's sequential probability ratio test of the inlier share of each kind.
class SequentialTest {
 public:
  explicit SequentialTest(const Expectation& expectation) {
    for (int kind = 0; kind < 2; ++kind) {
      const double good = expectation.goodShare[kind], chance = expectation.chanceShare[kind];
      if (!(good > chance)) continue;
      perInlier_[kind] = std::log(good / chance);
      perOutlier_[kind] = std::log((1 - good) / (1 - chance));
    }
  }
  // The log of the likelihood ratio good : chance.
  void add(int kind, int inliers, std::size_t count) {
    ratio_ += inliers * perInlier_[kind] + (static_cast<double>(count) - inliers) * perOutlier_[kind];
  }
  bool isHopeless() const { return ratio_ < kReject; }

 private:
  static constexpr double kReject = -4.605170185988091;  // log(kFalseRejection)
  double perInlier_[2] = {0, 0}, perOutlier_[2] = {0, 0}, ratio_ = 0;
};

}  // namespace

PoseScorer::PoseScorer(const CorrespondenceArrays& arrays, double maxEpipolarError, double maxReprojectionError,
                       sac::Scoring scoring)
    : arrays_(arrays),
      kernels_(kernels()),
      points_(arrays.pointArrays()),
      rays_(arrays.rayArrays()),
      maxEpipolarError_(maxEpipolarError),
      maxReprojectionError_(maxReprojectionError),
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

Score PoseScorer::score(const Chunk& chunk, const PlainPose& pose) const {
  if (chunk.isRays) return kernels_.scoreRays(rays_, pose, maxEpipolarError_ * maxEpipolarError_, chunk.begin, chunk.end);
  return kernels_.scorePoints(points_, pose, maxReprojectionError_ * maxReprojectionError_, chunk.begin, chunk.end);
}

double PoseScorer::gain(const Score& score) const { return scoring_ == sac::Scoring::Msac ? score.msac : score.inliers; }

Evaluation PoseScorer::evaluate(const FocalPose& pose) const {
  Expectation none;
  none.score = -1;
  return evaluate(pose, none);
}

Evaluation PoseScorer::evaluate(const FocalPose& pose, const Expectation& expectation) const {
  const PlainPose plain = toPlain(pose);
  SequentialTest test(expectation);
  Evaluation result;
  std::size_t left = points_.size + rays_.size;
  for (const Chunk& chunk : chunks_) {
    const Score part = score(chunk, plain);
    const std::size_t count = chunk.end - chunk.begin;
    result.score += gain(part);
    (chunk.isRays ? result.rays : result.points) += part.inliers;
    left -= count;
    test.add(chunk.isRays ? 0 : 1, part.inliers, count);
    if (result.score + static_cast<double>(left) <= expectation.score || test.isHopeless()) return result;
  }
  result.complete = true;
  return result;
}

std::vector<double> PoseScorer::squaredRayErrors(const FocalPose& pose) const {
  std::vector<double> errors(rays_.size + correspondences::kPadding);
  kernels_.squaredRayErrors(rays_, toPlain(pose), errors.data());
  errors.resize(rays_.size);
  return errors;
}

std::vector<double> PoseScorer::squaredPointErrors(const FocalPose& pose) const {
  std::vector<double> errors(points_.size + correspondences::kPadding);
  kernels_.squaredPointErrors(points_, toPlain(pose), errors.data());
  errors.resize(points_.size);
  return errors;
}

void PoseScorer::inliers(const FocalPose& pose, std::vector<char>& rays, std::vector<char>& points) const {
  const auto below = [](const std::vector<double>& errors, double threshold) {
    std::vector<char> mask(errors.size());
    std::transform(errors.begin(), errors.end(), mask.begin(), [&](double e) { return e < threshold * threshold; });
    return mask;
  };
  rays = below(squaredRayErrors(pose), maxEpipolarError_);
  points = below(squaredPointErrors(pose), maxReprojectionError_);
}

}  // namespace robust
}  // namespace hybridgv
