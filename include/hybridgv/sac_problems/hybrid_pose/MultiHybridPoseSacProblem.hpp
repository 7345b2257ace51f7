/// \file
/// \brief Hybrid pose, with unknown or known focal length, as a problem for opengv::sac::MultiRansac.
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
#include <opengv/sac/MultiSampleConsensusProblem.hpp>
#include <optional>
#include <vector>

#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

/// The problem for OpenGV's loops over several lists of indices, here two: {2D-2D, 2D-3D}. Thresholds, the choice among the
/// solutions, seed, lifetime, and what the loop does that a problem cannot change are those of HybridPoseSacProblem.
///
///     opengv::sac::MultiRansac<MultiHybridPoseSacProblem> ransac;
///     ransac.sac_model_ = std::make_shared<MultiHybridPoseSacProblem>(adapter, Solver::H13f, 4.0, 2.0);
///     ransac.threshold_ = 1.0;
///     if (ransac.computeModel())  // ransac.inliers_ = {2D-2D, 2D-3D}
///       ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
class MultiHybridPoseSacProblem : public opengv::sac::MultiSampleConsensusProblem<FocalPose> {
 public:
  using model_t = FocalPose;                                   ///< the model, under the name that OpenGV's loops ask for
  using adapter_t = hybridgv::hybrid_pose::HybridAdapterBase;  ///< where the data come from, under OpenGV's name

  /// Copies the adapter's correspondences; parameters and errors are those of HybridPoseSacProblem's constructor.
  MultiHybridPoseSacProblem(const adapter_t& adapter, Solver solver, double maxReprojectionErrorPx, double maxEpipolarErrorPx,
                            std::uint64_t seed = 0, std::optional<double> knownFocalLengthPx = {}, double distortion = 0)
      : MultiSampleConsensusProblem(false),
        core_(adapter, solver, maxReprojectionErrorPx, maxEpipolarErrorPx, knownFocalLengthPx, distortion),
        raysFromOneCamera_(core_.drawsRaysFromOneCamera()),
        pool_(core_.makePool({})) {
    rng_gen_ = std::make_shared<std::function<int()>>(randomSequence(seed));
    setUniformIndices({core_.size()[0], core_.size()[1]});
    preparePool();
  }

  /// Whether the 2D-2D correspondences of a sample come from one rig camera, as HybridPoseSacProblem::setRaysFromOneCamera.
  void setRaysFromOneCamera(bool oneCamera) { raysFromOneCamera_ = oneCamera; }

  /// The size of a sample: {m, n} for m 2D-2D and n 2D-3D correspondences.
  std::vector<int> getSampleSizes() const override { return {core_.sampleSize()[0], core_.sampleSize()[1]}; }

  /// Draws m 2D-2D and n 2D-3D correspondences of the lists set by setIndices, as HybridPoseSacProblem::getSamples.
  void getSamples(int& /*iterations*/, std::vector<std::vector<int>>& samples) override {
    for (int check = 0; check == 0 || check < max_sample_checks_; ++check) {
      drawSample(samples);
      if (samples.empty() || isSampleGood(samples)) return;
    }
  }

  /// False for a sample that cannot fix the pose; what that is, HybridProblemCore::isSampleGood says.
  bool isSampleGood(const std::vector<std::vector<int>>& sample) const override { return core_.isSampleGood(sample); }

  /// Solves a sample and keeps the solution that explains the indices set by setIndices best (HybridProblemCore::computeModel).
  bool computeModelCoefficients(const std::vector<std::vector<int>>& indices, model_t& outModel) const override {
    return core_.computeModel(indices, pool(), outModel);
  }

  /// Errors of the correspondences, each divided by the threshold of its kind (HybridProblemCore::distances).
  void getSelectedDistancesToModel(const model_t& model, const std::vector<std::vector<int>>& indices,
                                   std::vector<std::vector<double>>& scores) const override {
    std::vector<double> flat;
    core_.distances(model, core_.join(indices), flat);
    const auto middle = flat.begin() + static_cast<std::ptrdiff_t>(indices[0].size());
    scores = {{flat.begin(), middle}, {middle, flat.end()}};
  }

  /// How many distances are below `threshold`, which OpenGV's loops set to `threshold_` (HybridProblemCore::countWithin).
  int countWithinDistance(const model_t& model, const double threshold) override {
    return core_.countWithin(model, pool(), threshold);
  }

  /// hybrid_pose::optimize_nonlinear on the inliers, a known focal length being kept; nothing but optimizedModel is written.
  void optimizeModelCoefficients(const std::vector<std::vector<int>>& inliers, const model_t& model,
                                 model_t& optimizedModel) override {
    optimizedModel = core_.optimize(inliers, model);
  }

 private:
  // See HybridPoseSacProblem.
  void drawSample(std::vector<std::vector<int>>& samples) {
    if (pooled_ != indices_ || !hasPooledSizes()) preparePool();
    core_.drawSample(pool_, raysFromOneCamera_, *rng_gen_, places_);
    if (std::any_of(places_.begin(), places_.end(), [this](int place) { return isStale(static_cast<std::size_t>(place)); })) {
      preparePool();
      core_.drawSample(pool_, raysFromOneCamera_, *rng_gen_, places_);
    }
    if (places_.empty()) return samples.clear();
    samples.resize(2);
    for (std::vector<int>& list : samples) list.clear();
    for (const int place : places_) {
      const bool isRay = static_cast<std::size_t>(place) < pooledRays_;
      samples[isRay ? 0 : 1].push_back(pool_.indices()[static_cast<std::size_t>(place)] - (isRay ? 0 : core_.size()[0]));
    }
  }

  void preparePool() {
    pool_ = core_.makePool(core_.join(*indices_));
    pooledRays_ = (*indices_)[0].size();
    pooled_ = indices_;
  }

  bool hasPooledSizes() const {
    return indices_->size() == 2 && (*indices_)[0].size() == pooledRays_ &&
           (*indices_)[1].size() == pool_.indices().size() - pooledRays_;
  }
  // Whether the pool has another correspondence at this place than the lists.
  bool isStale(std::size_t place) const {
    const int flat = place < pooledRays_ ? (*indices_)[0][place] : core_.size()[0] + (*indices_)[1][place - pooledRays_];
    return pool_.indices()[place] != flat;
  }
  bool isCurrent() const {
    if (!hasPooledSizes()) return false;
    for (std::size_t place = 0; place < pool_.indices().size(); ++place)
      if (isStale(place)) return false;
    return true;
  }
  CorrespondencePool pool() const { return isCurrent() ? pool_ : core_.makePool(core_.join(*indices_)); }

  HybridProblemCore core_;
  bool raysFromOneCamera_;
  CorrespondencePool pool_;  // the 2D-2D correspondences, then the 2D-3D ones
  std::size_t pooledRays_ = 0;
  std::shared_ptr<std::vector<std::vector<int>>> pooled_;
  std::vector<int> places_;
};

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
