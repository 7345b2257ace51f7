/// \file
/// \brief The two errors by which a pose with focal length is judged, in pixels.
#pragma once

#include <Eigen/Core>

#include "hybridgv/export.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace hybrid_pose {

/// Distance of an observed image point from the projection of its rig point,
///
///     | (u, v) - f (x/z, y/z) |,   (x, y, z) = rotation^T (X - position).
///
/// \param imagePoint  (u, v, 1), or any multiple of it [px]
/// \param point       X, in the rig's frame
/// \return pixels; infinite if the point is not in front of the query (z <= 0) or anything is not finite. Never NaN.
HYBRIDGV_EXPORT double reprojectionError(const FocalPose& pose, const Eigen::Vector3d& imagePoint, const Eigen::Vector3d& point);

/// The same in an image with radial distortion: the projection is distorted (distortion.hpp), so that the error is one in pixels of
/// the image as it is.
///
/// \param distortion  of the division model [1/px^2]
/// \return pixels; infinite also where the projection is seen nowhere, 4 distortion (u^2 + v^2) >= 1. Never NaN.
HYBRIDGV_EXPORT double reprojectionError(const FocalPose& pose, double distortion, const Eigen::Vector3d& imagePoint,
                                         const Eigen::Vector3d& point);

/// Sampson error of a 2D-2D correspondence: to first order, how far the two image points (query and map) must move together to
/// satisfy the epipolar constraint.
///
/// In the rig's frame let r1, r2, r3 be the columns of `rotation`, w = u r1 + v r2 + f r3 the query's viewing direction,
/// t = camOffset - position, D the direction of the rig camera's ray (scaled to depth 1 in that camera), and a1, a2 the axes of
/// its image. The constraint is
///
///     C = w . (t x D) = 0,
///
/// its derivatives by the query's pixels are r1 . l and r2 . l with l = t x D, by the map image's pixels a1 . n / g and a2 . n /
/// g with n = w x t and g the map image's focal length, and the error is
///
///     |C| / sqrt( (r1.l)^2 + (r2.l)^2 + ((a1.n)^2 + (a2.n)^2) / g^2 ).
///
/// \param imagePoint      (u, v, 1) in the query, or any multiple of it [px]
/// \param bearingVector   viewing direction in the rig camera's frame, any positive length
/// \param camOffset       centre of the rig camera, in the rig's frame
/// \param camRotation     rig camera's frame -> rig's
/// \param rigFocalLength  g [px]; where it is 0 (unknown), g is the query's focal length
///
/// A bearing vector that does not point forwards (z <= 0, omnidirectional cameras) has no pixel in a pinhole image: its error is
/// measured in the tangent plane of the unit sphere, with g pixels per radian; D then has length 1 and a1, a2 span that plane.
///
/// \return pixels; infinite if the two viewing rays do not meet in front of both cameras (where the closest points of the
///         two lines decide; parallel rays do not meet), if the query lies in the rig camera's centre, or if anything is not
///         finite. Never NaN.
HYBRIDGV_EXPORT double sampsonError(const FocalPose& pose, const Eigen::Vector3d& imagePoint,
                                    const Eigen::Vector3d& bearingVector, const Eigen::Vector3d& camOffset,
                                    const Eigen::Matrix3d& camRotation, double rigFocalLength);

/// The same in an image with radial distortion, where (u, v) is seen in the direction w = u r1 + v r2 + f (1 + c (u^2 + v^2)) r3,
/// c the distortion. The derivatives of C by the query's pixels are then r1 . l + 2 c f u r3 . l and r2 . l + 2 c f v r3 . l.
///
/// \param distortion  of the division model [1/px^2] (distortion.hpp)
/// \return pixels; infinite also for 1 + c (u^2 + v^2) <= 0. Never NaN.
HYBRIDGV_EXPORT double sampsonError(const FocalPose& pose, double distortion, const Eigen::Vector3d& imagePoint,
                                    const Eigen::Vector3d& bearingVector, const Eigen::Vector3d& camOffset,
                                    const Eigen::Matrix3d& camRotation, double rigFocalLength);

}  // namespace hybrid_pose
}  // namespace hybridgv
