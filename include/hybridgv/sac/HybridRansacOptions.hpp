/// \file
/// \brief What hybridRansac may do, and the reasons that it gives.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace sac {

/// A minimal solver that may be drawn, with the weight of its choice before anything is known about the data (> 0).
struct SolverPrior {
  Solver solver;     ///< the minimal solver
  double prior = 1;  ///< its weight relative to the others'; only the ratios matter
};

/// All solvers with the weights that suit most data: H70f, which is for rays alone, is left out; P35Pf and P4Pf have a tenth of the
/// others' weight, because P3P at a guess of the focal length finds the same poses with a point less; H22 has half of it, H41 and H60 a
/// fifth, because P3P as a rule has found the pose in a fraction of the time that one sample of theirs takes.
HYBRIDGV_EXPORT std::vector<SolverPrior> defaultSolvers();

/// What makes a pose better than another.
enum class Scoring {
  Msac,         ///< sum over all correspondences of max(0, 1 - (error/threshold)^2)
  InlierCount,  ///< number of correspondences with error below the threshold
};

/// How samples are drawn.
enum class Sampling {
  Uniform,         ///< every sample of a solver is equally likely
  QualityOrdered,  ///< correspondences with larger weights first (PROSAC), where the adapter's weights differ; else Uniform
};

/// What is unknown of the query camera beside its focal length.
enum class QueryCamera {
  Pinhole,  ///< nothing: image points are undistorted
  Radial,   ///< one parameter of radial distortion: image points are raw pixels, relative to the principal point
};

/// What hybridRansac may do. Every length is in pixels of the query image (that is, in the unit of the adapter's image points),
/// nothing is squared.
struct HYBRIDGV_EXPORT HybridRansacOptions {
  /// Upper bounds of an inlier's error: 2D-3D, the reprojection error; 2D-2D, the Sampson error. The noise of each kind, and with it
  /// the limit between inliers and outliers, is found by the search itself, so a bound need only not be too small. 0 (automatic): a
  /// twentieth (2D-3D) and a hundredth (2D-2D) of the diagonal of the box that holds most image points, and not less than 0.004 of the
  /// focal length where that is known, if only roughly.
  double maxReprojectionErrorPx = 0;
  double maxEpipolarErrorPx = 0;  ///< see maxReprojectionErrorPx

  /// Stop when the probability to have missed a sample of inliers only, over all solvers together, is below 1 minus this.
  double successProbability = 0.9999;
  /// Samples drawn at least (if maxIterations allows): noisy data have local optima that look good enough to stop at, and a few
  /// more samples are cheap. Four times as many where the distortion is unknown, with which there are more of these, and a third as many
  /// where the focal length is known, without which there are most.
  int minIterations = 24;
  int maxIterations = 10000;                                           ///< samples drawn at most
  double timeBudgetSeconds = std::numeric_limits<double>::infinity();  ///< no new sample after this time

  /// [px] Solutions with a smaller one are dropped. 0 (automatic): a fifth of the width of the image that the image points fill, by the median of
  /// their coordinates: a field of view of 136 degrees. None if the focal length is known, if only roughly, or if maxFocalLength or that of
  /// initialPose is not at least twice as large.
  double minFocalLength = 0;
  double maxFocalLength = std::numeric_limits<double>::infinity();  ///< [px] solutions with a larger one are dropped

  /// [px] The focal length, if it is known: of a calibrated camera, for example. It is kept, and six parameters are estimated. An error
  /// of it shows only as far as the images contradict it: in fewer inliers, and in a noise that is too large for the matches.
  std::optional<double> knownFocalLengthPx;
  /// [px] The focal length, if it is known roughly: from EXIF, or of another image. It is estimated, but of poses that fit equally well
  /// the one near to this value is taken, and a pose that agrees with it needs about one inlier less to be believed. Its logarithm has
  /// Student's distribution with 3 degrees of freedom, so that a wrong value gives way to the data.
  std::optional<double> focalLengthPriorPx;
  /// Of log f: 0.1 for what cameras store, 0.3 for a guess.
  double focalLengthPriorLogDeviation = 0.1;

  /// [px] Standard deviation of each coordinate of the principal point from which image points are measured: 0 where it is known, about
  /// 0.5 % of the image's longer side where the image's centre stands for it. The pose does not depend on it, but its covariance does. An
  /// error of the principal point turns and moves the pose and leaves no trace in the inliers' errors.
  double principalPointDeviationPx = 0;

  /// A success needs a standard deviation of the focal length below this share of it, also without the rays that have most
  /// influence on it.
  double maxFocalLengthDeviation = 0.3;

  /// Radial estimates the lens distortion too, and keeps it if the data speak for it; pixels must be square. Map images and rays of the
  /// rig are free of distortion in either case.
  QueryCamera queryCamera = QueryCamera::Pinhole;
  /// [px] Half the image's diagonal, the unit of what follows: a distortion of the division model (distortion.hpp) is lambda / radius^2.
  /// 0, or if image points are farther from the principal point: the largest distance of one (but at most twice their
  /// 95 % quantile, and eight times their 75 % one).
  double imageRadiusPx = 0;
  double distortionScale = 0.05;  ///< of lambda before anything is seen: it is Cauchy distributed about 0
  /// Natural log of the odds that are needed to keep the distortion, otherwise the result is that of a pinhole camera. -infinity keeps
  /// it always, which is better where the lens is known to have distortion and matches are few (below 20 of each kind).
  double distortionEvidence = 1;
  /// Each sample is undistorted by one of these lambdas, all equally likely, before it is solved. They must be in (-0.7, 0.3), within
  /// which lambda is estimated. Lenses between them and somewhat beyond are found.
  std::vector<double> distortionHypotheses = {0, -0.1, -0.25};

  /// The solvers to choose from. One whose correspondences are absent is left out by itself, and with a known focal length one that
  /// estimates it. Those that need it are given knownFocalLengthPx; or a guess, P3P always, the others if there is a prior, and without
  /// they are left out.
  std::vector<SolverPrior> solvers = defaultSolvers();
  Scoring scoring = Scoring::Msac;               ///< what makes a pose better, as long as it is not optimized
  Sampling sampling = Sampling::QualityOrdered;  ///< how samples are drawn
  bool localOptimization = true;  ///< optimize promising models over both kinds; the likeliest is kept, the noise being estimated
  bool finalOptimization = true;  ///< optimize the result's likelihood to full precision
  /// A pose to start from, scored before the first sample. It competes on its score alone, so a wrong one does no harm. Its focal
  /// length must be from minFocalLength to maxFocalLength.
  std::optional<FocalPose> initialPose;

  /// Everything random is derived from it: equal seeds give bit-identical results, for any number of threads.
  std::uint64_t seed = 0;
  /// Hypotheses tried in parallel; 0 = one per processor core. More than four per core are not started, and where the system
  /// gives fewer threads, those there are do the work.
  int threads = 1;

  /// \throws std::invalid_argument that names the option and its value
  void check() const;
};

/// Why there is no result.
enum class FailureReason {
  None,                   ///< success
  TooFewCorrespondences,  ///< no enabled solver has enough data
  NoModel,                ///< no sample gave a pose with inliers
  InliersMayBeChance,     ///< wrong poses of random data have as many inliers
  UndeterminedPose,       ///< the inliers do not fix all seven parameters; without points, rays of one rig camera never do
  /// other correspondences agree with another pose, and are more than four fifths as many, or the same ones agree with a mirrored pose
  /// (HybridRansacResult::secondPose)
  AmbiguousPose,
};

/// What ended the search.
enum class StopReason {
  NotStarted,     ///< no sample was drawn
  Confident,      ///< successProbability reached
  MaxIterations,  ///< maxIterations reached
  TimeBudget,     ///< timeBudgetSeconds reached
  NoMoreSamples,  ///< there are no more samples, or no pose in so few correspondences that could be relied on is left to be found
};

/// The reason in words: "none", "too few correspondences", and so on.
HYBRIDGV_EXPORT const char* toString(FailureReason reason);
/// What ended the search, in words: "not started", "confident", and so on.
HYBRIDGV_EXPORT const char* toString(StopReason reason);

}  // namespace sac
}  // namespace hybridgv
