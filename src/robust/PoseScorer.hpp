// The score of a pose over all correspondences.
#pragma once

#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/Levels.hpp"
#include "robust/PerKind.hpp"
#include "robust/QueryPose.hpp"
#include "robust/WorkerPool.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

using correspondences::CorrespondenceArrays;

struct Evaluation {
  double score = 0;
  int points = 0, rays = 0;     // inliers
  bool complete = false;        // false: given up as hopeless
  PerKind<double> scale{1, 1};  // of the thresholds over their bounds
};

// The log of the likelihood ratio of two shares of inliers, per inlier and per outlier.
struct LogRatio {
  LogRatio() = default;
  // Zero, which tests nothing, unless the good share is larger.
  LogRatio(double good, double chance);
  double of(int inliers, int count) const { return inliers * perInlier + (count - inliers) * perOutlier; }

  double perInlier = 0, perOutlier = 0;
};

// When to give up on a pose. It must be able to exceed `score`, and must not look like one whose inliers are chance: Wald's
// sequential test between the inlier shares of a pose worth keeping and of a wrong one.
struct Expectation {
  Expectation() = default;
  Expectation(const PerKind<double>& goodShare, const PerKind<double>& chanceShare)
      : rays(goodShare.rays, chanceShare.rays), points(goodShare.points, chanceShare.points) {}

  double score = 0;
  LogRatio rays, points;
};

// The correspondences from which a pose was made: they are inliers whether it is right or wrong, and so are not evidence.
struct OwnCorrespondences {
  PerKind<const int*> indices;
  PerKind<int> count;
};

// Probability that the sequential test gives up a pose that has the good shares. One that has twice as large shares is given up with
// about the square of it.
constexpr double kFalseRejection = 0.1;

class PoseScorer {
 public:
  // The arrays must outlive the scorer and be in random order.
  PoseScorer(const CorrespondenceArrays& arrays, const PerKind<double>& bounds, sac::Scoring scoring);

  // From now on they share the work of evaluate(pose) and inliers, which must not be called by them then.
  void setWorkers(WorkerPool& workers) { workers_ = &workers; }

  // Over all correspondences.
  Evaluation evaluate(const QueryPose& pose) const;
  // The same, given up early where there is no hope. Of the two kinds that one comes first of which a wrong pose is sooner seen to
  // be one.
  Evaluation evaluate(const QueryPose& pose, const Expectation& expectation, const OwnCorrespondences& own = {}) const;
  // The same test for the points alone, with a threshold `scale` times its bound: whether the pose may be a good one.
  bool pointsLeaveHope(const QueryPose& pose, double scale, const Expectation& expectation, const OwnCorrespondences& own) const;
  // Over all correspondences, with the thresholds at which the inliers exceed most clearly what chance gives: bounds / 2^k of each
  // kind. `chance`: shares of a wrong pose's inliers; `errors`: room for those of both kinds.
  // The score is left out, of which few ask.
  Evaluation evaluateAtClearestLevels(const QueryPose& pose, const Shares& chance, PerKind<std::vector<double>>& errors) const;
  // That of such an evaluation, with the errors that it left.
  double score(const Evaluation& evaluation, const PerKind<std::vector<double>>& errors) const;
  // Masks of the correspondences whose error is below their kind's threshold times `factor`, but at most its bound.
  PerKind<std::vector<char>> inliers(const QueryPose& pose, double factor = 1) const;
  // The same for any thresholds, larger than the bounds, too.
  PerKind<std::vector<char>> within(const PerKind<double>& thresholds, const QueryPose& pose) const;
  // Errors of one kind at a pose, infinite for those that are no inliers.
  std::vector<double> squaredRayErrors(const QueryPose& pose) const;
  std::vector<double> squaredPointErrors(const QueryPose& pose) const;
  // Those of rays, finite also beyond infinity (BeyondInfinity).
  std::vector<double> squaredRayErrorsBeyondInfinity(const QueryPose& pose) const;

  const CorrespondenceArrays& arrays() const { return arrays_; }
  // The thresholds of inliers, at first their bounds.
  const PerKind<double>& thresholds() const { return thresholds_; }
  const PerKind<double>& bounds() const { return bounds_; }
  // The thresholds over their bounds.
  PerKind<double> scale() const { return {thresholds_.rays / bounds_.rays, thresholds_.points / bounds_.points}; }
  void setThresholds(const PerKind<double>& thresholds) { thresholds_ = thresholds; }

 private:
  struct Chunk {
    bool isRays;
    std::size_t begin, end;
  };
  static std::vector<Chunk> makeChunks(bool isRays, std::size_t size);
  // Adds the correspondences of chunks to the evaluation. False if the rest need not be looked at.
  template <class Test>
  bool addAll(const std::vector<Chunk>& chunks, double threshold, const PlainPose& pose, Test& test,
              Evaluation& evaluation) const;
  double scoreOf(const std::vector<double>& squaredErrors, double threshold, int inliers) const;
  void computeErrors(const QueryPose& pose, PerKind<std::vector<double>>& errors) const;

  const CorrespondenceArrays& arrays_;
  PointArrays points_;
  RayArrays rays_;
  PerKind<double> bounds_, thresholds_;
  sac::Scoring scoring_;
  PerKind<std::vector<Chunk>> chunks_;
  WorkerPool* workers_ = nullptr;
};

}  // namespace robust
}  // namespace hybridgv
