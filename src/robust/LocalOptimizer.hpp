// Local optimization of a pose over the inliers of both kinds.
#pragma once

#include "correspondences/PaddedValues.hpp"
#include "robust/ChanceModel.hpp"
#include "robust/ErrorMixture.hpp"
#include "robust/LeastSquares.hpp"
#include "robust/PoseScorer.hpp"

namespace hybridgv {
namespace robust {

using SquaredErrors = PerKind<std::vector<double>>;
using Noise = PerKind<ErrorMixture>;

struct FinalPose {
  QueryPose pose;
  Noise noise;
  ParameterMatrix information;  // for this noise
};

class LocalOptimizer {
 public:
  // The scorer and the chance model must outlive the optimizer.
  LocalOptimizer(const PoseScorer& scorer, const ChanceModel& chance, double minFocalLength, double maxFocalLength,
                 Intrinsics estimated = {});

  // From a minimal solution to a local optimum of the truncated squared errors, then of the likelihood. The truncation starts
  // wide, because a solution from noisy points is far from most viewing rays, and narrows down to the thresholds.
  QueryPose refine(const QueryPose& start) const;
  // To a local optimum of the likelihood; the noise of each kind is estimated on the way.
  QueryPose settle(const QueryPose& start, const Kinds& kinds) const;
  // The same to full precision, then with single rays kept from deciding alone (narrowingByLeverage). Without `optimize` only the
  // noise and the information of the start.
  FinalPose polish(const QueryPose& start, bool optimize) const;
  // The pose moved along its optical axis so that the inlier points' mean depth is `factor` times as large, and likewise the
  // focal length. Without points the origin stands for them.
  QueryPose atDistance(const QueryPose& pose, double factor) const;
  // Log of the likelihood of all errors, for the noise that they show, over that of outliers only.
  double logLikelihood(const QueryPose& pose) const;
  // The kinds with more inliers than a wrong pose has; both if none has.
  Kinds moreThanChance(const QueryPose& pose) const;

 private:
  // A kind that is not used counts as absent.
  SquaredErrors squaredErrors(const QueryPose& pose, const Kinds& kinds) const;
  Noise noise(const SquaredErrors& errors, double focalLength) const;

  struct Steps {
    int iterations;
    double minDecrease;
  };
  QueryPose minimized(const KindLoss& rayLoss, const KindLoss& pointLoss, const QueryPose& start, const Kinds& kinds,
                      const Steps& steps) const;
  QueryPose likeliest(const QueryPose& start, const Kinds& kinds, int rounds, const Steps& steps) const;
  // The same with narrowed losses of the rays, which are returned (see RayArrays; empty without rounds).
  QueryPose withoutLevers(const QueryPose& start, const Kinds& kinds, int rounds, const Steps& steps,
                          correspondences::PaddedValues& narrowing) const;
  LeastSquaresOptions limits(const Steps& steps) const;
  LeastSquaresProblem problem(const KindLoss& rayLoss, const KindLoss& pointLoss, const Kinds& kinds) const;

  const PoseScorer& scorer_;
  const ChanceModel& chance_;
  double minFocalLength_, maxFocalLength_;
  Intrinsics estimated_;
};

}  // namespace robust
}  // namespace hybridgv
