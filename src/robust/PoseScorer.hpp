// The score of a pose over all correspondences.
#pragma once

#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/Levels.hpp"
#include "robust/PerKind.hpp"
#include "robust/QueryPose.hpp"
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

// When to give up on a pose. It must be able to exceed `score`, and must not look like one whose inliers are chance: Wald's
// sequential test between the inlier shares of a pose worth keeping and of a wrong one.
struct Expectation {
  double score = 0;
  PerKind<double> goodShare, chanceShare;  // no test of a kind whose good share is not larger
};

// Probability that the sequential test gives up a pose that has the good shares.
constexpr double kFalseRejection = 0.01;

class PoseScorer {
 public:
  // The arrays must outlive the scorer and be in random order.
  PoseScorer(const CorrespondenceArrays& arrays, const PerKind<double>& bounds, sac::Scoring scoring);

  // Over all correspondences.
  Evaluation evaluate(const QueryPose& pose) const;
  // The same, given up early where there is no hope.
  Evaluation evaluate(const QueryPose& pose, const Expectation& expectation) const;
  // Over all correspondences, with the thresholds at which the inliers exceed most clearly what chance gives: bounds / 2^k of each
  // kind. `chance`: shares of a wrong pose's inliers; `errors`: room for those of both kinds.
  Evaluation evaluateAtClearestLevels(const QueryPose& pose, const Shares& chance, PerKind<std::vector<double>>& errors) const;
  // Masks of the correspondences whose error is below their kind's threshold.
  PerKind<std::vector<char>> inliers(const QueryPose& pose) const;
  // Errors of one kind at a pose, infinite for those that are no inliers.
  std::vector<double> squaredRayErrors(const QueryPose& pose) const;
  std::vector<double> squaredPointErrors(const QueryPose& pose) const;

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
  void makeChunks();
  // Adds the chunk's correspondences to the evaluation; returns its inliers.
  int add(const Chunk& chunk, const Kernels& kernels, const PlainPose& pose, Evaluation& evaluation) const;
  double scoreOf(const std::vector<double>& squaredErrors, double threshold, int inliers) const;
  void computeErrors(const QueryPose& pose, PerKind<std::vector<double>>& errors) const;

  const CorrespondenceArrays& arrays_;
  PointArrays points_;
  RayArrays rays_;
  PerKind<double> bounds_, thresholds_;
  sac::Scoring scoring_;
  std::vector<Chunk> chunks_;
};

}  // namespace robust
}  // namespace hybridgv
