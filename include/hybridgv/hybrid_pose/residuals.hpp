/// \file
/// \brief The two errors by which a pose with focal length is judged, in pixels.
#pragma once

#include <Eigen/Core>

#include "hybridgv/export.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace hybrid_pose {

/// Distance [px] of the image point (u, v, 1) from the projection of the rig point; infinite if the point is not in front of the
/// query or anything is not finite.
HYBRIDGV_EXPORT double reprojectionError(const FocalPose& pose, const Eigen::Vector3d& imagePoint, const Eigen::Vector3d& point);

/// Sampson error [px] of a 2D-2D correspondence: to first order, how far the two image points (query and map) must move together
/// to satisfy the epipolar constraint. The map image's pixel is taken from rigFocalLength, or from the query's focal length where
/// that is 0 (unknown). Infinite if the viewing rays do not meet in front of both cameras or anything is not finite.
HYBRIDGV_EXPORT double sampsonError(const FocalPose& pose, const Eigen::Vector3d& imagePoint,
                                    const Eigen::Vector3d& bearingVector, const Eigen::Vector3d& camOffset,
                                    const Eigen::Matrix3d& camRotation, double rigFocalLength);

}  // namespace hybrid_pose
}  // namespace hybridgv
