/// \file
/// \brief Robust pose and focal length from hybrid 2D-2D and 2D-3D correspondences.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace sac {

/// What hybridRansac has found.
struct HYBRIDGV_EXPORT HybridRansacResult {
  bool success = false;                                  ///< the pose can be relied on
  FailureReason failureReason = FailureReason::NoModel;  ///< None on success

  FocalPose pose;  ///< also set if success is false and a model was found (see score), but not to be relied on
  /// 1 for an inlier, one entry per 2D-2D correspondence. An inlier's error is below the options' bound, and so small that it is
  /// more likely an inlier's than an outlier's (or at most 2.5 standard deviations).
  std::vector<char> inliers2d2d;
  std::vector<char> inliers2d3d;  ///< the same for each 2D-3D correspondence
  int numberInliers2d2d = 0;      ///< number of inliers among the 2D-2D correspondences
  int numberInliers2d3d = 0;      ///< number of inliers among the 2D-3D correspondences
  double score = 0;               ///< score of the pose, by options.scoring; 0 without a model

  /// The seven parameters' covariance [row-major 7x7]: small rotation in the query's frame [rad] (rotation * exp([.]x)),
  /// position, log focal length. It follows from the noise of the inliers, noise2d3d and noise2d2d, and from what happens to
  /// the pose if the rays of one rig camera, or one of 64 groups of points, are left out (jackknife), so that errors of the rig show.
  /// Correspondences of one feature of the query are not independent in it (HybridAdapterBase::getFeature2d2d).
  /// Errors that all correspondences share do not; that of the principal point is allowed for if options.principalPointDeviationPx
  /// states how large it may be. All infinite if the inliers do not fix the pose.
  std::array<double, 49> covariance{};
  double focalLengthStandardDeviation = std::numeric_limits<double>::infinity();  ///< [px] by the same covariance

  /// Another pose that correspondences agree with which are no inliers of `pose`, more of them than chance gives: as where a facade
  /// repeats itself, or the map has the same thing twice. Which of the two is right, correspondences cannot tell. It is looked for
  /// after a success, among the correspondences that are no inliers, if these are at least 0.8 times as many. One with 0.8 of the
  /// support is seldom missed (5 % for samples of three points, more often if rays alone agree with it). Empty without one. Under
  /// QueryCamera::Radial its focal length belongs to a distortion of its own, which is not reported.
  ///
  /// Or, where the focal length is known, exactly or roughly, the mirrored pose of a flat object far away, with which the same correspondences
  /// agree, if it is about as likely (log-likelihoods that differ by less than 6).
  std::optional<FocalPose> secondPose;
  /// The correspondences that only secondPose explains, over those that only `pose` explains; 1 for a mirrored pose. Above 0.8 there is no
  /// success.
  double secondPoseSupport = 0;

  /// Of the division model, undistorted = (u, v) / (1 + distortion (u^2 + v^2)) [1/px^2], to which pose.focalLength belongs; see
  /// distortion.hpp. 0 if options.queryCamera is Pinhole, and if the data do not speak for distortion.
  double distortion = 0;
  double distortionStandardDeviation = 0;  ///< [1/px^2]; 0 if there is no distortion
  /// The same lens as COLMAP's SIMPLE_RADIAL, fitted where the inliers are: to compare with a focal length from there, use this. It
  /// has the same relative standard deviation as pose.focalLength. Without distortion it is pose.focalLength; 0 without a model.
  double simpleRadialFocalLength = 0;
  double simpleRadialK1 = 0;                   ///< k1; 0 without distortion
  double simpleRadialK1StandardDeviation = 0;  ///< 0 without distortion

  double noise2d2d = 0;  ///< [px] standard deviation of the Sampson errors of what is more likely an inlier than an outlier
  double noise2d3d = 0;  ///< [px] the same of the reprojection errors, for each of the two coordinates

  std::optional<Solver> solver;                    ///< whose solution led to the pose; empty if it was options.initialPose
  int iterations = 0;                              ///< samples drawn
  std::map<Solver, int> iterationsPerSolver;       ///< samples drawn by each
  int localOptimizations = 0;                      ///< runs of the local optimization
  StopReason stopReason = StopReason::NotStarted;  ///< what ended the search
  double seconds = 0;                              ///< wall-clock time taken
};

/// Hybrid LO-RANSAC: finds the query's pose and focal length from correspondences with outliers of both kinds.
///
/// Each iteration draws a solver and a sample of it, and scores every solution over all correspondences of both kinds, the errors
/// divided by their own thresholds. A solver is drawn with probability proportional to
///
///     prior x P_s / cost_s,
///
/// P_s the (hypergeometric) probability that a sample of solver s has inliers only, by the best model so far, cost_s its time; a
/// solver that takes more than 1.5 times as long as another to find such a sample is not drawn. Promising models are optimized
/// over both kinds, and compared by their likelihoods for the noise of their inliers, so that the thresholds need not be near to
/// it. With k_s samples of solver s so far, the search ends when
///
///     prod_s (1 - P_s)^k_s < 1 - successProbability.
///
/// So data of one kind that are all outliers cost no more than the samples wasted on them, and an absent kind costs nothing.
///
/// The Sampson error uses the rig camera's own focal length where the adapter knows it (getRigFocalLength), else about the width of
/// the query's image: twice the 95 % quantile of the larger coordinates of its points, at most eight times the 75 % one. (With the
/// query's focal length, the error of any rays would vanish as that goes to 0, and fall as it grows. One that is known, if only
/// roughly, is the least.) Image points, viewing rays and points must be finite.
///
/// The inliers are too many to be chance if the expected number of wrong poses with as many is below 1e-6. That is judged by the
/// data themselves: by inliers that are *different* (a rig point, a viewing ray or a feature of the query counts once, however
/// often it is listed), against the shares of inliers that wrong pairs of the same data have. Rays that would decide about the pose
/// alone, and which the other correspondences do not predict, are no inliers.
///
/// \return success only if the inliers are too many to be chance and fix all seven parameters, the focal length to
///         options.maxFocalLengthDeviation; see FailureReason.
/// \throws std::invalid_argument for wrong options (see check()) and data that are not finite
HYBRIDGV_EXPORT HybridRansacResult hybridRansac(const hybrid_pose::HybridAdapterBase& adapter,
                                                const HybridRansacOptions& options = {});

}  // namespace sac
}  // namespace hybridgv
