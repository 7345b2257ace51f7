/// \file
/// \brief Hybrid pose, with unknown or known focal length, as a problem for opengv::sac::Ransac and opengv::sac::Lmeds.
#pragma once

// OpenGV's sac headers do not include all they need: <algorithm>, <climits>, <cmath>, <limits> and Eigen must come first.
#include <Eigen/Core>
#include <algorithm>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <opengv/sac/SampleConsensusProblem.hpp>
#include <optional>
#include <vector>

#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

/// One flat list of indices: 0 .. n2d2d-1 are the 2D-2D correspondences of the adapter, the 2D-3D ones follow.
///
///     opengv::sac::Ransac<HybridPoseSacProblem> ransac;
///     ransac.sac_model_ = std::make_shared<HybridPoseSacProblem>(adapter, Solver::H13f, 4.0, 2.0);
///     ransac.threshold_ = 1.0;
///     if (ransac.computeModel())  // ransac.model_coefficients_ is a FocalPose, ransac.inliers_ are flat indices
///       ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
///
/// * **Thresholds** are in pixels of the query image, one for each kind. The distance that OpenGV sees is the error divided by
///   its threshold, so `threshold_` is always 1.0 (OpenGV's default). It is always finite. For the Sampson error, a rig camera
///   whose focal length the adapter does not know (getRigFocalLength) has about the width of the query's image, or its focal length
///   where that is known, as in sac::hybridRansac.
/// * **Samples** are minimal: m 2D-2D and n 2D-3D correspondences, every such set equally likely, and no further
///   correspondence to choose among several solutions. OpenGV wants one model for a sample: it gets the solution that explains
///   the whole index list best. That costs one pass over the correspondences for each solution (about 1 us for 400 of them); the
///   loop's own count is one more. In exchange the right solution is kept practically always, where one extra correspondence
///   keeps it in 82 to 95 % of the cases (50 to 20 % outliers, 1 px noise) and would enlarge the sample in the loop's stopping
///   rule.
/// * **H51f**, **H41** draw their rays from one rig camera where one has enough, **H60** and **H70f** all but one of them (see
///   setRaysFromOneCamera).
/// * **Seed**: the same seed gives the same samples on every platform, and the same result on the same machine. All random
///   numbers come from OpenGV's rnd(), which this class sets up.
/// * **Data**: the adapter is only read, once, in the constructor, and may be destroyed afterwards. Several problems may share
///   one, also in several threads.
///
/// What the loops themselves do and a problem cannot change:
///
/// * They know one pooled inlier share, so that their number of iterations is right only if both kinds have similar shares. It
///   is too small if the kind of which the solver needs more has the smaller share: raise `probability_`.
/// * Ransac runs max_iterations_ + 1 iterations. Samples without a solution are not counted, but limited to
///   10 max_iterations_, which must stay below 2^31.
/// * Lmeds minimizes the median over both kinds together: more than half of all correspondences must be inliers.
/// * A second call of computeModel on the same loop object that finds nothing leaves the first one's model there and returns
///   true.
class HybridPoseSacProblem : public opengv::sac::SampleConsensusProblem<FocalPose> {
 public:
  using model_t = FocalPose;                                   ///< the model, under the name that OpenGV's loops ask for
  using adapter_t = hybridgv::hybrid_pose::HybridAdapterBase;  ///< where the data come from, under OpenGV's name

  /// \param adapter  the correspondences
  /// \param solver  the minimal solver
  /// \param maxReprojectionErrorPx  largest reprojection error of an inlier among the 2D-3D correspondences [px]
  /// \param maxEpipolarErrorPx  largest Sampson error of an inlier among the 2D-2D correspondences [px]
  /// \param seed  of everything random
  /// \param knownFocalLengthPx  of the query [px], for a solver that needs it (P3P ..), and only for one of these
  /// \param distortion  of the query's image [1/px^2] (distortion.hpp), for instance from sac::hybridRansac: it is removed from the image
  ///        points first, and thresholds are in pixels of the undistorted image. OpenGV's loops cannot estimate it.
  ///
  /// \throws std::invalid_argument for fewer correspondences than the solver needs, thresholds that are not positive and finite,
  ///         a focal length that is not, is missing or is given to a solver that estimates it, correspondences that are not finite, a distortion
  ///         with which an image point has no viewing direction.
  HybridPoseSacProblem(const adapter_t& adapter, Solver solver, double maxReprojectionErrorPx, double maxEpipolarErrorPx,
                       std::uint64_t seed = 0, std::optional<double> knownFocalLengthPx = {}, double distortion = 0)
      : SampleConsensusProblem(false),
        core_(adapter, solver, maxReprojectionErrorPx, maxEpipolarErrorPx, knownFocalLengthPx, distortion),
        raysFromOneCamera_(core_.drawsRaysFromOneCamera()),
        pool_(core_.makePool({})) {
    rng_gen_ = std::make_shared<std::function<int()>>(randomSequence(seed));
    setUniformIndices(core_.size()[0] + core_.size()[1]);
    preparePool();
  }

  /// Whether the 2D-2D correspondences of a sample come from one rig camera, or for H70f all but one (the default for these two,
  /// where it is about a hundred times faster: 9 instead of 56 and 118 solutions) or from any (the default for the others). Where no
  /// rig camera has enough, they come from any in either case.
  void setRaysFromOneCamera(bool oneCamera) { raysFromOneCamera_ = oneCamera; }

  /// The size of a sample: m + n.
  int getSampleSize() const override { return core_.sampleSize()[0] + core_.sampleSize()[1]; }

  /// Draws m 2D-2D and n 2D-3D correspondences of the list set by setIndices. A degenerate sample is drawn again, up to
  /// max_sample_checks_ times; the last one is returned in any case, and computeModelCoefficients then finds no model for it.
  /// Empty, which ends the loop, if the list has too few of one kind.
  void getSamples(int& /*iterations*/, std::vector<int>& samples) override {
    for (int check = 0; check == 0 || check < max_sample_checks_; ++check) {
      drawSample(samples);
      if (samples.empty() || isSampleGood(samples)) return;
    }
  }

  /// False for a sample that cannot fix the pose; what that is, HybridProblemCore::isSampleGood says.
  bool isSampleGood(const std::vector<int>& sample) const override { return core_.isFlatSampleGood(sample); }

  /// Solves a sample and keeps the solution that explains the indices set by setIndices best (HybridProblemCore::computeModel).
  bool computeModelCoefficients(const std::vector<int>& indices, model_t& outModel) const override {
    return core_.computeModel(core_.split(indices), pool(), outModel);
  }

  /// Errors of the correspondences, each divided by the threshold of its kind (HybridProblemCore::distances).
  void getSelectedDistancesToModel(const model_t& model, const std::vector<int>& indices,
                                   std::vector<double>& scores) const override {
    core_.distances(model, indices, scores);
  }

  /// How many distances are below `threshold`, which OpenGV's loops set to `threshold_` (HybridProblemCore::countWithin).
  int countWithinDistance(const model_t& model, const double threshold) override {
    return core_.countWithin(model, pool(), threshold);
  }

  /// hybrid_pose::optimize_nonlinear on the inliers, a known focal length being kept; nothing but optimizedModel is written.
  void optimizeModelCoefficients(const std::vector<int>& inliers, const model_t& model, model_t& optimizedModel) override {
    optimizedModel = core_.optimize(core_.split(inliers), model);
  }

 private:
  // A list that was replaced or resized is noticed at once, an entry that was written over when it is drawn.
  void drawSample(std::vector<int>& samples) {
    if (pooled_ != indices_ || pool_.indices().size() != indices_->size()) preparePool();
    core_.drawSample(pool_, raysFromOneCamera_, *rng_gen_, samples);
    const auto isStale = [this](int place) { return entry(*indices_, place) != entry(pool_.indices(), place); };
    if (std::any_of(samples.begin(), samples.end(), isStale)) {
      preparePool();
      core_.drawSample(pool_, raysFromOneCamera_, *rng_gen_, samples);
    }
    for (int& sample : samples) sample = entry(*indices_, sample);
  }

  void preparePool() {
    pool_ = core_.makePool(*indices_);
    pooled_ = indices_;
  }

  // The pool of the list as it is now. Scoring takes much longer than comparing.
  CorrespondencePool pool() const { return pool_.indices() == *indices_ ? pool_ : core_.makePool(*indices_); }

  static int entry(const std::vector<int>& list, int place) { return list[static_cast<std::size_t>(place)]; }

  HybridProblemCore core_;
  bool raysFromOneCamera_;
  CorrespondencePool pool_;
  std::shared_ptr<std::vector<int>> pooled_;  // the list of which pool_ was made: kept, so that no other can take its place
};

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
