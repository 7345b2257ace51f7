/// \file
/// \brief What the hybrid problems for OpenGV's sample-consensus loops have in common, in the compiled library.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

/// Indices of correspondences, a list for each kind: {2D-2D, 2D-3D}.
using MultiIndices = std::vector<std::vector<int>>;

/// A list of correspondences from which samples are drawn and over which solutions are counted, prepared once by
/// HybridProblemCore::makePool. Copies share it.
class HYBRIDGV_EXPORT CorrespondencePool {
 public:
  /// The flat indices of which it was made, in their order. (They may repeat, and then count as often.)
  const std::vector<int>& indices() const;

 private:
  friend class HybridProblemCore;
  struct Data;
  explicit CorrespondencePool(std::shared_ptr<const Data> data);
  std::shared_ptr<const Data> data_;
};

/// The mathematics behind HybridPoseSacProblem and MultiHybridPoseSacProblem, which are thin and header-only because OpenGV's
/// base classes are templates that belong to the user's program. Use it directly only to write another loop.
///
/// All functions are const and may be called from several threads at once. Copies share the (constant) data.
class HYBRIDGV_EXPORT HybridProblemCore {
 public:
  /// Copies the adapter's correspondences; it is not needed afterwards.
  ///
  /// `knownFocalLengthPx`: of the query, for a solver that needs it, and only for one of these. `distortion`: of the division model
  /// [1/px^2] (distortion.hpp), known and removed from the query's image points before anything else; thresholds are then in pixels of
  /// the undistorted image.
  ///
  /// \throws std::invalid_argument for fewer correspondences than the solver needs, thresholds that are not positive and finite,
  ///         a focal length that is not, is missing or is given to a solver that estimates it, correspondences that are not finite, a distortion
  ///         with which an image point has no viewing direction.
  HybridProblemCore(const hybridgv::hybrid_pose::HybridAdapterBase& adapter, Solver solver, double maxReprojectionErrorPx,
                    double maxEpipolarErrorPx, std::optional<double> knownFocalLengthPx = {}, double distortion = 0);

  /// Numbers of 2D-2D and 2D-3D correspondences of the data.
  std::array<int, 2> size() const;
  /// How many 2D-2D and 2D-3D correspondences the solver needs.
  std::array<int, 2> sampleSize() const;
  /// Whether the solver has a much faster way for rays of one rig camera, so that samples should be drawn so.
  bool drawsRaysFromOneCamera() const;

  /// Flat indices: 0 .. n2d2d-1 are the 2D-2D correspondences, the 2D-3D ones follow. Throws std::invalid_argument for an index
  /// that is out of range.
  MultiIndices split(const std::vector<int>& flat) const;
  /// The inverse of split: flat indices, those of the 2D-2D correspondences first.
  std::vector<int> join(const MultiIndices& indices) const;

  /// Prepares a list of flat indices. Throws std::invalid_argument for an index that is out of range.
  CorrespondencePool makePool(const std::vector<int>& flat) const;

  /// Draws a minimal sample with random numbers 0 .. 2^31-1, in a time that does not depend on the size of the pool: every subset of
  /// the right mixture is equally likely. The result are places in pool.indices(), of the 2D-2D correspondences first; empty if the
  /// pool is too small. `raysFromOneCamera`: the 2D-2D correspondences (H60, H70f: all but one) come from one rig camera, chosen with
  /// a probability proportional to its number of matches among those that have enough; where none has, from any cameras.
  void drawSample(const CorrespondencePool& pool, bool raysFromOneCamera, const std::function<int()>& random,
                  std::vector<int>& places) const;

  /// False for a sample that no solver can use: a repeated correspondence, two points seen at one place, collinear or coincident
  /// first three points, two rays of one camera with one direction, a ray through a point of the sample. All up to 1e-6, relative.
  bool isSampleGood(const MultiIndices& sample) const;
  /// The same for flat indices, in any order.
  bool isFlatSampleGood(const std::vector<int>& sample) const;

  /// Solves the sample and keeps that solution which explains the pool best, by the sum of min(distance^2, 1). Returns false if
  /// there is no solution.
  bool computeModel(const MultiIndices& sample, const CorrespondencePool& pool, FocalPose& model) const;

  /// Distances of correspondences (flat indices) to the model, in the same order: each an error in pixels divided by its own
  /// threshold; finite (kMaxDistance for a point behind the camera, and for a model that is not finite, which the loops may ask
  /// for).
  void distances(const FocalPose& model, const std::vector<int>& flat, std::vector<double>& result) const;

  /// How many distances of the pool are below `threshold`, which must not be negative.
  int countWithin(const FocalPose& model, const CorrespondencePool& pool, double threshold) const;

  /// hybrid_pose::optimize_nonlinear on the inliers, a known focal length being kept; std::invalid_argument for a model that is not a pose.
  FocalPose optimize(const MultiIndices& inliers, const FocalPose& model) const;

  /// Stands for an infinite distance: OpenGV's loops add distances up.
  static constexpr double kMaxDistance = 1e6;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// An endless sequence of random numbers 0 .. 2^31-1 that depends on the seed alone, not on the standard library.
HYBRIDGV_EXPORT std::function<int()> randomSequence(std::uint64_t seed);

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
