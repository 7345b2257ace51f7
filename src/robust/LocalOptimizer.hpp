// Local optimization of a pose over the inliers of both types.
#pragma once

#include "robust/ChanceModel.hpp"
#include "robust/LeastSquares.hpp"
#include "robust/PoseScorer.hpp"

namespace hybridgv {
namespace robust {

// The inliers of one type: the standard deviation of their errors (2D-3D: per coordinate), and the error from which a
// correspondence is more likely an outlier [px].
struct Spread {
  double deviation = 0, truncation = 0;
};

struct Noise {
  Spread rays, points;
};

struct FinalPose {
  FocalPose pose;
  Noise noise;
  Matrix7 information = Matrix7::Zero();  // of the pose, for this noise
};

// The types that an optimization uses.
struct Types {
  bool rays = true, points = true;
};

class LocalOptimizer {
 public:
  // The scorer and the chance model must outlive the optimizer.
  LocalOptimizer(const PoseScorer& scorer, const ChanceModel& chance, double minFocalLength, double maxFocalLength);

  // From a minimal solution to a local optimum of the truncated squared errors. The truncation starts wide, because a solution
  // from noisy points is far from most viewing rays, and narrows down to the thresholds.
  FocalPose refine(const FocalPose& start, const Types& types = {}) const;
  // From a local optimum to the most likely pose: each type is weighed by its own noise, and truncated where an outlier is more
  // likely. Without `optimize` only the noise and the information of the start.
  FinalPose polish(const FocalPose& start, bool optimize) const;
  // The pose moved along its optical axis so that the inlier points' mean depth is `factor` times as large, and likewise the
  // focal length. Without points the origin stands for them.
  FocalPose atDistance(const FocalPose& pose, double factor) const;
  Noise noise(const FocalPose& pose) const;
  // The types with more inliers than a wrong pose has; both if none has.
  Types moreThanChance(const FocalPose& pose) const;

 private:
  LeastSquaresProblem problem(const Noise& noise, const Types& types) const;
  FocalPose truncated(const FocalPose& start, const Noise& noise, const Types& types, int iterations, double minDecrease) const;

  const PoseScorer& scorer_;
  const ChanceModel& chance_;
  double minFocalLength_, maxFocalLength_;
};

}  // namespace robust
}  // namespace hybridgv
