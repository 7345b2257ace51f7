/// \file
/// \brief Robust pose and focal length from hybrid 2D-2D and 2D-3D correspondences.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace sac {

/// A minimal solver that may be drawn, with the weight of its choice before anything is known about the data (> 0).
struct SolverPrior {
  Solver solver;     ///< which
  double prior = 1;  ///< relative to the others; only the ratios matter
};

/// What makes a pose better than another.
enum class Scoring {
  Msac,         ///< sum over all correspondences of max(0, 1 - (error/threshold)^2)
  InlierCount,  ///< number of correspondences with error below the threshold
};

/// How samples are drawn.
enum class Sampling {
  Uniform,         ///< every sample of a type is equally likely
  QualityOrdered,  ///< correspondences with larger weights first (PROSAC), where the adapter's weights differ; else Uniform
};

/// What hybridRansac may do. Every length is in pixels of the query image (that is, in the unit of the adapter's image points),
/// nothing is squared.
struct HYBRIDGV_EXPORT HybridRansacOptions {
  double maxReprojectionErrorPx = 12;  ///< 2D-3D: largest reprojection error of an inlier
  double maxEpipolarErrorPx = 6;       ///< 2D-2D: largest Sampson error of an inlier

  /// Stop when the probability to have missed a sample of inliers only, over all solvers together, is below 1 minus this.
  double successProbability = 0.9999;
  /// Samples drawn at least (if maxIterations allows): noisy data have local optima that look good enough to stop at, and a few
  /// more samples are cheap.
  int minIterations = 48;
  int maxIterations = 10000;                                           ///< samples drawn at most
  double timeBudgetSeconds = std::numeric_limits<double>::infinity();  ///< no new sample after this time

  double minFocalLength = 0;                                        ///< [px] smaller ones are no solutions
  double maxFocalLength = std::numeric_limits<double>::infinity();  ///< [px] larger ones are no solutions

  /// The solvers to choose from. One whose correspondences are absent is left out by itself.
  std::vector<SolverPrior> solvers = {
      {Solver::P4Pf, 1}, {Solver::P35Pf, 0.1}, {Solver::H13f, 1}, {Solver::H32f, 1}, {Solver::H51f, 1}};
  Scoring scoring = Scoring::Msac;               ///< what makes a pose better, as long as it is not optimized
  Sampling sampling = Sampling::QualityOrdered;  ///< how samples are drawn
  bool localOptimization = true;  ///< optimize promising models over both types; the likeliest is kept, the noise being estimated
  bool finalOptimization = true;  ///< optimize the result's likelihood to full precision
  /// A pose to start from, scored before the first sample. It competes on its score alone, so a wrong one does no harm.
  std::optional<FocalPose> initialPose;

  /// Everything random is derived from it: equal seeds give bit-identical results, for any number of threads.
  std::uint64_t seed = 0;
  int threads = 1;  ///< hypotheses tried in parallel; 0 = one per processor core

  /// \throws std::invalid_argument that names the option and its value
  void check() const;
};

/// Why there is no result.
enum class FailureReason {
  None,                   ///< success
  TooFewCorrespondences,  ///< no enabled solver has enough data
  NoModel,                ///< no sample gave a pose with inliers
  InliersMayBeChance,     ///< wrong poses of random data have as many inliers
  UndeterminedPose,       ///< the inliers do not fix all seven parameters
};

/// What ended the search.
enum class StopReason {
  NotStarted,     ///< no sample was drawn
  Confident,      ///< successProbability reached
  MaxIterations,  ///< maxIterations reached
  TimeBudget,     ///< timeBudgetSeconds reached
};

/// "none", "too few correspondences", ...
HYBRIDGV_EXPORT const char* toString(FailureReason reason);
/// "not started", "confident", ...
HYBRIDGV_EXPORT const char* toString(StopReason reason);

/// What hybridRansac has found.
struct HYBRIDGV_EXPORT HybridRansacResult {
  bool success = false;                                  ///< the pose can be relied on
  FailureReason failureReason = FailureReason::NoModel;  ///< None on success

  FocalPose pose;                 ///< also set if success is false and a model was found (see score), but not to be relied on
  std::vector<char> inliers2d2d;  ///< 1 for an inlier, one entry per 2D-2D correspondence
  std::vector<char> inliers2d3d;  ///< 1 for an inlier, one entry per 2D-3D correspondence
  int numberInliers2d2d = 0;      ///< of 2D-2D correspondences
  int numberInliers2d3d = 0;      ///< of 2D-3D correspondences
  double score = 0;               ///< of the pose, by options.scoring; 0 without a model

  /// The seven parameters' covariance [row-major 7x7]: small rotation in the query's frame [rad] (rotation * exp([.]x)),
  /// position, log focal length. It follows from the noise of the inliers, noise2d3d and noise2d2d. All infinite if the inliers
  /// do not fix the pose.
  std::array<double, 49> covariance{};
  double focalLengthStandardDeviation = std::numeric_limits<double>::infinity();  ///< [px]
  double noise2d2d = 0;  ///< [px] standard deviation of the Sampson errors, without those that are more likely outliers
  double noise2d3d = 0;  ///< [px] standard deviation of the reprojection errors per coordinate, likewise

  std::optional<Solver> solver;                    ///< whose solution led to the pose; empty if it was options.initialPose
  int iterations = 0;                              ///< samples drawn
  std::map<Solver, int> iterationsPerSolver;       ///< samples drawn by each
  int localOptimizations = 0;                      ///< runs of the local optimization
  StopReason stopReason = StopReason::NotStarted;  ///< what ended the search
  double seconds = 0;                              ///< wall-clock time taken
};

/// Hybrid LO-RANSAC: finds the query's pose and focal length from correspondences with outliers of both types.
///
/// Each iteration draws a solver and a sample of it, and scores every solution over all correspondences of both types, the errors
/// divided by their own thresholds. A solver is drawn with probability proportional to
///
///     prior x P_s / cost_s,
///
/// P_s the (hypergeometric) probability that a sample of solver s has inliers only, by the best model so far, cost_s its time; a
/// solver that takes more than 1.5 times as long as another to find such a sample is not drawn. Promising models are optimized
/// over both types, and compared by their likelihoods for the noise of their inliers, so that the thresholds need not be near to
/// it. With k_s samples of solver s so far, the search ends when
///
///     prod_s (1 - P_s)^k_s < 1 - successProbability.
///
/// So data of one type that are all outliers cost no more than the samples wasted on them, and an absent type costs nothing.
///
/// The Sampson error uses the rig camera's own focal length where the adapter knows it (getRigFocalLength), else the query's
/// current one, but at least twice the largest coordinate of the image points (with the focal length the error of any rays would
/// vanish). Image points, viewing rays and points must be finite.
///
/// \return success only if the inliers are too many to be chance and fix all seven parameters; see FailureReason.
/// \throws std::invalid_argument for wrong options (see check()) and data that are not finite
HYBRIDGV_EXPORT HybridRansacResult hybridRansac(const hybrid_pose::HybridAdapterBase& adapter,
                                                const HybridRansacOptions& options = {});

}  // namespace sac
}  // namespace hybridgv
