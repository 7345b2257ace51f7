// The search for the best pose: hypotheses in batches, local optimization of every new best one.
#pragma once

#include <array>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/ChanceModel.hpp"
#include "robust/FocalLengthGuess.hpp"
#include "robust/GatheredSamples.hpp"
#include "robust/Lens.hpp"
#include "robust/LocalOptimizer.hpp"
#include "robust/LookAlikes.hpp"
#include "robust/PoseScorer.hpp"
#include "robust/SearchData.hpp"
#include "robust/Significance.hpp"
#include "robust/SolverChoice.hpp"
#include "robust/StagedSampling.hpp"
#include "robust/Thresholds.hpp"
#include "robust/WorkerPool.hpp"
#include "robust/sampleLimit.hpp"

namespace hybridgv {
namespace robust {

using Clock = std::chrono::steady_clock;

// How many workers a search with these options can use.
std::size_t workersFor(const sac::HybridRansacOptions& options);

// A pose (in the normalized frame) with its evaluation.
struct Model {
  QueryPose pose;
  Evaluation evaluation;
  std::optional<Solver> solver;
  double logLikelihood = 0;  // of an optimized one
};

// Hypotheses are tried in batches. Within a batch each one depends on its number and on what was known before the batch only, so
// that the threads may try them in any order.
class HybridSearch {
 public:
  // `part`: of all, those that are searched in, if they are many.
  HybridSearch(SearchData all, std::optional<SearchData> part, const sac::HybridRansacOptions& options, WorkerPool& workers,
               Clock::time_point start);

  ~HybridSearch();
  HybridSearch(const HybridSearch&) = delete;
  HybridSearch& operator=(const HybridSearch&) = delete;

  bool canStart() const { return !choice_.strategies().empty() || options_.initialPose; }
  // Rays enough, but no scale: they come from one rig camera.
  bool lacksScale() const;
  // Minimal solutions that may well be chance are never optimized: for a search that is not expected to find anything.
  void considerPromisingOnly() { promisingOnly_ = true; }
  void run();
  // Final optimization of the best model (or only its noise and information).
  FinalPose finish(bool optimize);
  // Another pose that the same correspondences agree with, after `finish`: which of the two is right, they do not tell.
  const std::optional<QueryPose>& mirrored() const { return mirrored_; }
  // Whether the best model, as `finish` left it, can be trusted.
  sac::FailureReason verdict(const FinalPose& final);

  bool hasModel() const { return best_.evaluation.score > 0; }
  const Model& best() const { return best_; }
  const SolverChoice& choice() const { return choice_; }
  const SearchData& data() const { return all_; }
  const SearchData& searchedData() const { return data_; }
  // Of the searched data, with the thresholds as they are now.
  InlierMasks inliersOf(const QueryPose& pose) const { return scorer_.inliers(pose); }
  const PerKind<double>& bounds() const { return scorer_.bounds(); }
  QueryPose optimized(const QueryPose& pose) const { return optimizer_.refine(pose); }
  // Of the best model, over all correspondences, after `finish`.
  const PerKind<std::vector<char>>& inliers() const { return inliers_; }
  double score() const { return score_; }
  WorkerPool& workers() const { return workers_; }
  Intrinsics estimated() const { return estimated_; }
  int iterations() const { return iterations_; }
  int localOptimizations() const { return localOptimizations_; }
  sac::StopReason stopReason() const { return stopReason_; }

 private:
  // A solution that competes with others by how unlikely it is to be chance.
  struct Candidate {
    // Of equally good ones the earlier is better, so that the best of many does not depend on the order in which they are compared. Only what is
    // less good than another one anyway may lack its score.
    bool isLessLikelyChance(const Candidate& other) const;

    Model model;
    double logChance = 0;
    int number = 0;  // of the hypothesis
  };
  struct NumberedPose {
    int number = 0;  // of the hypothesis
    QueryPose pose;
  };
  // What one worker found in a batch. Nothing is kept of the other hypotheses: their number has no bound.
  struct WorkerState {
    std::array<FocalPose, solvers::kMaxSolutions> solutions;  // scratch
    GatheredSamples gathered;                                 // not yet solved
    std::vector<int> draws;                                   // per strategy
    PerKind<std::vector<double>> errors;                      // scratch
    StagedSampling::OwnScores ownScores;                      // of the batch
    std::vector<NumberedPose> promising;                      // of the batch's first samples, before any pose is believed
    std::optional<Candidate> best;
  };

  void tryInitialPose();
  void tryBatch(int count);
  LocalOptimizer makeOptimizer(const PoseScorer& scorer, const ChanceModel& chance, const QueryFeatures& features) const;
  // Of a sample, that one draws from.
  std::size_t variants() const;
  int mostIterations() const;
  int leastIterations() const;
  // The size of the next batch after one of this size.
  int nextBatch(int batch) const;
  void tryHypothesis(int number, WorkerState& worker) const;
  // The poses of a sample to worker.solutions; their number. Those of a sample that is gathered follow when it is solved with others.
  int solve(const Hypothesis& hypothesis, const SampleReader& reader, RandomStream& random, WorkerState& worker) const;
  double focalLengthOf(const Strategy& strategy, RandomStream& random) const;
  void solveGathered(WorkerState& worker) const;
  void considerSolutions(const Hypothesis& hypothesis, const FocalPose* poses, int count, WorkerState& worker) const;
  void considerSolution(const QueryPose& pose, const Strategy& strategy, const OwnCorrespondences& own, int number,
                        WorkerState& worker) const;
  bool rate(Candidate& candidate, WorkerState& worker) const;
  void rateByPairs(Candidate& candidate, WorkerState& worker) const;
  void learnFromPairs(const Candidate& notBelieved);
  Evaluation evaluate(const QueryPose& pose, const Strategy& strategy, const OwnCorrespondences& own, WorkerState& worker) const;
  double firstScale() const;
  Expectation findable() const;
  void consider(const Model& candidate);
  void compare(const Model& optimized);
  void setThresholds(const Model& model);
  Thresholds thresholdsAt(const QueryPose& pose) const;
  void findThresholds(Model& model);
  void tryNarrowerThreshold(Model& model);
  void replaceIfLikelier(const QueryPose& pose, Model& model) const;
  void escapeLocalOptimum(Model& model, std::initializer_list<double> distanceFactors) const;
  FinalPose polishBest();
  Optimum optimumOfBest();
  Optimum polished();
  FinalPose bestBeside(FinalPose best) const;
  FinalPose polishedAtDistance(const FinalPose& pose, double factor) const;
  bool isBetterDetermined(const FinalPose& pose, const FinalPose& than) const;
  // The likeliest of the pose and those that look the same; what is nearly as likely becomes mirrored().
  FinalPose likelierOfMirrored(const FinalPose& pose, const LookAlikes& others, const LocalOptimizer& optimizer,
                               const PoseScorer& scorer);
  // Of log f.
  double deviationOf(const FinalPose& pose) const;
  void takeOutDistortion();
  void setBest(const Model& model, bool isSignificant);
  void learnFrom(const Model& model);
  bool isWorthConsidering(const Candidate& candidate);
  bool leadsToBest(const QueryPose& pose) const;
  bool isBetter(const Model& model, bool isSignificant) const;
  bool hasMissedNothing();
  bool isDone();
  bool isOutOfTime() const;
  bool isDetermined(const FinalPose& final) const;
  // The best model has been optimized for a part of the correspondences.
  // With `optimize`, for all of them; masks, score, noise and covariance are those of all anyway.
  FinalPose fitToAll(const FinalPose& ofPart, bool optimize);
  void judgeAll(const PoseScorer& scorer);
  // Within the thresholds times `factor`.
  InlierCounts inlierCounts(const QueryPose& pose, double factor = 1) const;

  const sac::HybridRansacOptions& options_;
  Clock::time_point start_;
  // All correspondences, a part of them if they are many, and those of the two that are searched in.
  SearchData all_;
  std::optional<SearchData> part_;
  const SearchData& data_;
  Lens lens_;
  Intrinsics estimated_;
  SolverChoice choice_;
  double leastFocalLength_;
  FocalLengthGuess guess_;
  RobustBox::Size image_;
  PoseScorer scorer_;
  ChanceModel chance_;
  Shares chanceShares_;  // of a wrong pose's inliers, as long as no pose is believed
  QueryFeatures features_;
  std::optional<QueryFeatures> featuresOfAll_;  // if a part is searched in: set by a task of the workers
  Significance significance_;
  LocalOptimizer optimizer_;
  std::optional<StagedSampling> staged_;  // if a strategy needs it
  std::optional<LeastSupports> leastSupports_;
  WorkerPool& workers_;
  std::vector<WorkerState> workerStates_;

  Model best_;
  std::optional<QueryPose> mirrored_;
  PerKind<std::vector<char>> inliers_;
  double score_ = 0;
  std::optional<Candidate> bestCandidate_;
  bool bestIsSignificant_ = false, promisingOnly_ = false, asksPairs_ = false;
  Expectation expectation_;           // once a pose is significant
  Expectation ofThreePointsAtFirst_;  // of a pose from three points at least, before
  int iterations_ = 0, mostIterations_ = 0, localOptimizations_ = 0;
  sac::StopReason stopReason_ = sac::StopReason::NotStarted;
};

}  // namespace robust
}  // namespace hybridgv
