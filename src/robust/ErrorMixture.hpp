// The errors of one kind of correspondence as a mixture of those of inliers and of outliers.
#pragma once

#include <cstddef>
#include <vector>

#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

// An inlier's error e has a density proportional to (1 + (e/scale)^2)^-8 (on a line for rays, in the plane for points), which is
// Student's: near to the normal one, but real errors have tails like it. An outlier's density is even. So an error e is
//
//     odds / (1 + (e/scale)^2)^8
//
// times as likely an inlier's as an outlier's.
struct ErrorMixture {
  double deviation = 0;  // [px] of normal errors with the same median (2D-3D: per coordinate)
  double scale = 0;      // [px]
  double odds = 0;
  double outlierShare = 1;
  double boundary = 0;  // [px] where inlier and outlier are equally likely; at least 2.5 deviations, at most twice the
                        // threshold and the bound

  KindLoss loss() const;
  // How many times as likely an inlier's as an outlier's an error is.
  double oddsAt(double squaredError) const;
  // Log of the likelihood of the errors over that of outliers only.
  double logLikelihood(const std::vector<double>& squaredErrors) const;
};

// `inliers` of `all` errors are below the threshold, and as many of `all` outliers would be as `chanceShare` says. No error above the
// bound is an inlier's.
struct InlierCount {
  std::size_t inliers, all;
  double threshold, bound, chanceShare;
};
ErrorMixture rayMixture(double deviation, const InlierCount& count);
ErrorMixture pointMixture(double deviation, const InlierCount& count);

}  // namespace robust
}  // namespace hybridgv
