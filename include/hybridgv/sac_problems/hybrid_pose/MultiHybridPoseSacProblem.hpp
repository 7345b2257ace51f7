/// \file
/// \brief Hybrid pose with unknown focal length as a problem for opengv::sac::MultiRansac.
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
#include <vector>

#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

/// Two lists of indices: {2D-2D, 2D-3D}. In everything else it is HybridPoseSacProblem (see there): thresholds, choice among the
/// solutions, seed, lifetime, and what the loop does that a problem cannot change.
///
///     opengv::sac::MultiRansac<MultiHybridPoseSacProblem> ransac;
///     ransac.sac_model_ = std::make_shared<MultiHybridPoseSacProblem>(adapter, Solver::H13f, 4.0, 2.0);
///     ransac.threshold_ = 1.0;
///     if (ransac.computeModel())  // ransac.inliers_ = {2D-2D, 2D-3D}
///       ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
class MultiHybridPoseSacProblem : public opengv::sac::MultiSampleConsensusProblem<FocalPose> {
 public:
  using model_t = FocalPose;                                   ///< OpenGV's loops ask for this name
  using adapter_t = hybridgv::hybrid_pose::HybridAdapterBase;  ///< likewise

  /// See HybridPoseSacProblem.
  MultiHybridPoseSacProblem(const adapter_t& adapter, Solver solver, double maxReprojectionErrorPx, double maxEpipolarErrorPx,
                            std::uint64_t seed = 0)
      : MultiSampleConsensusProblem(false),
        core_(adapter, solver, maxReprojectionErrorPx, maxEpipolarErrorPx),
        raysFromOneCamera_(solver == Solver::H51f) {
    rng_gen_ = std::make_shared<std::function<int()>>(randomSequence(seed));
    setUniformIndices({core_.size()[0], core_.size()[1]});
  }

  /// See HybridPoseSacProblem.
  void setRaysFromOneCamera(bool oneCamera) { raysFromOneCamera_ = oneCamera; }

  /// {m, n}
  std::vector<int> getSampleSizes() const override { return {core_.sampleSize()[0], core_.sampleSize()[1]}; }

  /// See HybridPoseSacProblem.
  void getSamples(int& /*iterations*/, std::vector<std::vector<int>>& samples) override {
    for (int check = 0; check == 0 || check < max_sample_checks_; ++check) {
      samples = core_.drawSample(*indices_, raysFromOneCamera_, *rng_gen_);
      if (samples.empty() || isSampleGood(samples)) return;
    }
  }

  /// See HybridProblemCore::isSampleGood.
  bool isSampleGood(const std::vector<std::vector<int>>& sample) const override { return core_.isSampleGood(sample); }

  /// See HybridProblemCore::computeModel; the pool is the list set by setIndices.
  bool computeModelCoefficients(const std::vector<std::vector<int>>& indices, model_t& outModel) const override {
    return core_.computeModel(indices, core_.join(*indices_), outModel);
  }

  /// See HybridProblemCore::distances.
  void getSelectedDistancesToModel(const model_t& model, const std::vector<std::vector<int>>& indices,
                                   std::vector<std::vector<double>>& scores) const override {
    std::vector<double> flat;
    core_.distances(model, core_.join(indices), flat);
    const auto middle = flat.begin() + static_cast<std::ptrdiff_t>(indices[0].size());
    scores = {{flat.begin(), middle}, {middle, flat.end()}};
  }

  /// See HybridProblemCore::countWithin.
  int countWithinDistance(const model_t& model, const double threshold) override {
    return core_.countWithin(model, core_.join(*indices_), threshold);
  }

  /// hybrid_pose::optimize_nonlinear on the inliers; nothing but optimizedModel is written.
  void optimizeModelCoefficients(const std::vector<std::vector<int>>& inliers, const model_t& model,
                                 model_t& optimizedModel) override {
    optimizedModel = core_.optimize(inliers, model);
  }

 private:
  HybridProblemCore core_;
  bool raysFromOneCamera_;
};

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
