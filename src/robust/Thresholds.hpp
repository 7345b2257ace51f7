// The thresholds that divide inliers from outliers: what the user allows, and what a pose's own errors ask for.
#pragma once

#include <vector>

#include "robust/ChanceModel.hpp"
#include "robust/PerKind.hpp"
#include "robust/RobustBox.hpp"

namespace hybridgv {
namespace robust {

// [px] of the Sampson error of rays, of the reprojection error of points.
using Thresholds = PerKind<double>;

// The largest thresholds. Where none is given (0) it is a hundredth of the image's diagonal for rays, a twentieth for points; the image being
// what the image points fill, and so an object's that is small, at least 0.004 of the focal length if that is known (else 0).
Thresholds thresholdBounds(const Thresholds& given, double focalLength, const RobustBox::Size& image);

// 2.5 standard deviations of the inliers' errors at a pose, at most the bounds. Which are the inliers follows from the errors: the
// smallest of the thresholds T, T/2, T/4, .. that has three quarters of the largest excess over chance, twice as large.
// `bounds`: of which `chance` tells the shares.
Thresholds workingThresholds(const PerKind<std::vector<double>>& squaredErrors, const Thresholds& bounds,
                             const ChanceModel& chance);

}  // namespace robust
}  // namespace hybridgv
