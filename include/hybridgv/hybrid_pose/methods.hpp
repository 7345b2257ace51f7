/// \file
/// \brief Minimal solvers for mixed 2D-2D and 2D-3D correspondences, unknown focal length.
#pragma once

#include <array>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace hybrid_pose {

/// H13f. `indices[0]`: one 2D-2D correspondence, `indices[1]`: three 2D-3D ones.
HYBRIDGV_EXPORT FocalPoses h13f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices);
HYBRIDGV_EXPORT FocalPoses h13f(const HybridAdapterBase& adapter);

/// H51f. `indices[0]`: five 2D-2D correspondences, `indices[1]`: one 2D-3D one.
HYBRIDGV_EXPORT FocalPoses h51f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices);
HYBRIDGV_EXPORT FocalPoses h51f(const HybridAdapterBase& adapter);

/// Result of optimize_nonlinear.
struct HYBRIDGV_EXPORT NonlinearResult {
  FocalPose pose;
  bool converged = false;
  int iterations = 0;
  double cost = 0;  ///< sum of the squared residuals at the result [px^2]
  /// J^T J at the result, 7x7 row-major [1/px^2]: small rotation in the query's frame [rad], position, log focal length.
  std::array<double, 49> information{};
  /// Standard deviation of the focal length for residuals of 1 px standard deviation; infinite if the data do not fix it.
  double focalLengthStandardDeviation = 0;
};

/// Minimises reprojection errors (2D-3D) and Sampson errors (2D-2D), both in pixels.
HYBRIDGV_EXPORT NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                                   const FocalPose& initial);
HYBRIDGV_EXPORT NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const FocalPose& initial);

}  // namespace hybrid_pose
}  // namespace hybridgv
