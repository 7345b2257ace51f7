// Local optimization of a pose over the inliers of both kinds.
#pragma once

#include "robust/ChanceModel.hpp"
#include "robust/ErrorMixture.hpp"
#include "robust/Jackknife.hpp"
#include "robust/LeastSquares.hpp"
#include "robust/Lens.hpp"
#include "robust/Levers.hpp"
#include "robust/PoseScorer.hpp"
#include "robust/RaySlope.hpp"

namespace hybridgv {
namespace robust {

using SquaredErrors = PerKind<std::vector<double>>;
using Noise = PerKind<ErrorMixture>;

// An optimum of the likelihood with what was found on the way to it.
struct Optimum {
  QueryPose pose;
  Kinds kinds;  // that were used
  RayTreatment treatment;
  Noise noise;
  double rayWeight = 1;         // of the rays' squared errors over their variance, at most 1: see RaySlope
  bool depthsAreKnown = false;  // it has been seen that there is no RaySlope
};

// The refused rays of its treatment are no inliers, whatever their errors.
struct FinalPose : Optimum {
  bool isRegular = false;             // the inliers fix all parameters
  ParameterMatrix covariance = {};    // for this noise, and for errors that inliers share (FeatureNoise.hpp, Jackknife.hpp)
  double effectiveParameters = 0;     // tr(H V), H the information for independent errors, V the covariance
  double deviationWithoutLevers = 0;  // of log f, if rays with large leverages are left out
};

// How much likelier one pose is than another.
struct LikelihoodRatio {
  double log = 0;
  // By which that scatters where the two are as good. Poses in which the same is seen have the same errors of points, but epipolar lines in
  // different directions, so that the noise across them is another: the log is a sum of as many accidents as there are rays. (Q. Vuong,
  // Likelihood ratio tests for model selection and non-nested hypotheses, Econometrica 1989.)
  double deviation = 0;
};

class LocalOptimizer {
 public:
  // The scorer, the chance model and the features of the scorer's correspondences must outlive the optimizer.
  LocalOptimizer(const PoseScorer& scorer, const ChanceModel& chance, const QueryFeatures& features, double minFocalLength,
                 double maxFocalLength, Intrinsics estimated = {}, Lens lens = {}, FocalLengthPrior focalLengthPrior = {});

  // From now on they share the work if there are many correspondences. They must outlive the optimizer.
  void setWorkers(WorkerPool& workers);

  // From a minimal solution to a local optimum of the truncated squared errors, then of the likelihood. The truncation starts
  // wide, because a solution from noisy points is far from most viewing rays, and narrows down to the thresholds.
  QueryPose refine(const QueryPose& start) const;
  // To a local optimum of the likelihood; the noise of each kind is estimated on the way.
  QueryPose settle(const QueryPose& start, const Kinds& kinds) const;
  // The same to full precision, and with single rays kept from deciding alone (Levers.hpp, Leverage.hpp).
  Optimum polish(const QueryPose& start) const;
  // The same from a pose that was polished for a part of the correspondences.
  Optimum polishNear(const QueryPose& start, double rayWeight) const;
  // A pose as it is.
  Optimum keep(const QueryPose& pose) const;
  // With its covariance.
  FinalPose finish(const Optimum& optimum) const;
  // Enlarges the covariance by what comes from the principal point, both coordinates of which have this standard deviation [px].
  void allowForPrincipalPoint(double deviation, FinalPose& result) const;
  // Whether the deviation of the focal length is so small that no other optimum can be near.
  bool focalLengthIsSure(const QueryPose& pose) const;
  // Whether the likelihood falls clearly where the focal length is half or twice as large.
  bool focalLengthIsDetermined(const FinalPose& final) const;
  // The pose moved along its optical axis so that the inlier points' mean depth is `factor` times as large, and likewise the
  // focal length. Without points, the median depth at which the inlier rays seem to meet the query's.
  QueryPose atDistance(const QueryPose& pose, double factor) const;
  // Log of the likelihood of all errors, for the noise that they show, over that of outliers only.
  double logLikelihood(const QueryPose& pose) const;
  // Of a over b, for equal noise: that of the two for which the log is nearer to 0; 0 if they differ in the sign.
  LikelihoodRatio likelihoodRatio(const Optimum& a, const Optimum& b) const;
  // logEvidence for the distortion of this optimum of the likelihood; -infinity if its inliers do not fix the pose.
  double logEvidenceForDistortion(const Optimum& optimum) const;
  // From now on poses have no distortion.
  void forgetDistortion() { estimated_.radial = false; }
  // Of the rays that are inliers.
  RayNoise rayNoise(const Optimum& optimum) const;
  // The kinds with more inliers than a wrong pose has; both if none has.
  Kinds moreThanChance(const QueryPose& pose) const;

 private:
  // How far away rays may meet their viewing rays. To find a pose, not beyond infinity: there would be more poses that many agree with.
  enum class Reach { Infinity, BeyondInfinity };
  double depthOfScene(const QueryPose& pose) const;
  // A kind that is not used counts as absent.
  SquaredErrors squaredErrors(const QueryPose& pose, const Kinds& kinds, Reach reach) const;
  // `benefitOfDoubt`: a factor for the odds that a ray is an inlier, if there are as many points.
  Noise noise(const SquaredErrors& errors, double benefitOfDoubt = 1) const;
  Noise finalNoise(const SquaredErrors& errors) const;
  double logLikelihood(const QueryPose& pose, const SquaredErrors& errors) const;
  // For the noise of this optimum.
  double logLikelihood(const QueryPose& pose, const Kinds& kinds, const Optimum& noiseOf) const;
  // For these standard deviations of the inliers' errors [px].
  Noise mixtures(PerKind<double> deviations, const SquaredErrors& errors, double benefitOfDoubt = 1) const;
  // The narrowing must outlive the problem.
  static LeastSquaresProblem narrowed(LeastSquaresProblem problem, const correspondences::PaddedValues& narrowing);
  LeastSquaresProblem likelierInliers(const Noise& noise, const Kinds& kinds, double rayWeight) const;
  // The narrowing is not in it.
  LeastSquaresProblem inliersOf(const Optimum& optimum) const;
  Optimum keep(const QueryPose& pose, double rayWeight) const;
  // With the noise at this pose.
  Optimum optimumAt(const QueryPose& pose, const Kinds& kinds, const RayTreatment& treatment, double rayWeight) const;
  // `at`: the derivatives of the inliers' errors.
  void findCovariance(const LeastSquaresProblem& inliers, const Derivatives& at, FinalPose& result) const;
  void allowForDepths(const LeastSquaresProblem& inliers, const ParameterMatrix& information, FinalPose& result) const;
  void correctNoise(const ParameterMatrix& information, SharedInformation& shared, FinalPose& result) const;

  struct Steps {
    int iterations;
    double minDecrease;
  };
  static constexpr Steps kCoarse{10, 1e-4}, kPrecise{20, 1e-8};
  // Of errors that are truncated at these limits [px].
  QueryPose leastTruncated(double rayLimit, double pointLimit, const QueryPose& start, const Kinds& kinds,
                           const Steps& steps) const;
  QueryPose likeliest(const QueryPose& start, const Kinds& kinds, int rounds, const Steps& steps) const;
  // The squared errors of the rays count `rayWeight` times as much; they reach beyond infinity.
  LeastSquaresProblem mixtureProblem(const Noise& noise, const Kinds& kinds, double rayWeight) const;
  // Whether it counts how deep in the scene a lever lies.
  enum class LeverTest { WithDepths, WithoutDepths };
  Optimum withoutLevers(const QueryPose& start, const Kinds& kinds, LeverTest test, double rayWeight = 1) const;
  Optimum withBalancedRays(Optimum optimum) const;
  Optimum likeliestBeside(const Optimum& first, const QueryPose& firstStart) const;
  QueryPose withFaintRays(const QueryPose& start, const Kinds& kinds) const;
  double logEvidenceOf(const Optimum& optimum) const;
  double logLikelihoodOfDepths(const QueryPose& pose, const SquaredErrors& errors) const;
  struct Round {
    LeastSquaresProblem problem;
    Noise noise;
    Steps steps;
    LeverTest test;
    double rayWeight;
  };
  // Refuses levers that the other correspondences do not predict; the pose becomes the one without levers. Whether there are any.
  bool refuse(const std::vector<std::size_t>& levers, const Round& round, QueryPose& pose, RayTreatment& treatment) const;
  // `information`: of all.
  void leaveOutLevers(const LeastSquaresProblem& inliers, RayTreatment treatment, const ParameterMatrix& information,
                      FinalPose& result) const;
  // -2 log of the likelihood of what is estimated of the camera, before anything is seen.
  double priorCost(const QueryPose& pose) const;
  LeastSquaresOptions limits(const Steps& steps) const;
  LeastSquaresProblem problem(const KindLoss& rayLoss, const KindLoss& pointLoss, const Kinds& kinds) const;

  const PoseScorer& scorer_;
  const ChanceModel& chance_;
  const QueryFeatures& features_;
  JackknifeGroups groups_;
  double minFocalLength_, maxFocalLength_;
  Intrinsics estimated_;
  Lens lens_;
  FocalLengthPrior focalLengthPrior_;
  WorkerPool* workers_ = nullptr;
};

}  // namespace robust
}  // namespace hybridgv
