/// \file
/// \brief Radial distortion of an image: the division model that is estimated, and COLMAP's SIMPLE_RADIAL.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "hybridgv/export.hpp"

namespace hybridgv {

/// Where a pinhole camera would see what is seen at an image point of a camera with radial distortion (division model):
///
///     (u, v) -> (u, v) / (1 + distortion (u^2 + v^2)).
///
/// \param distortion  [1/px^2]; negative: barrel distortion. 0 is a pinhole image.
/// \param imagePoint  (u, v, 1), or any multiple of it, relative to the principal point [px]; pixels must be square
/// \return (u', v', 1); (u, v, 0) where 1 + distortion (u^2 + v^2) is not positive, which no viewing direction belongs to; (0, 0, 0)
///         if anything is not finite. The inverse of distort where distortion (u^2 + v^2) < 1: strong pincushion distortion sees a direction twice.
HYBRIDGV_EXPORT Eigen::Vector3d undistort(double distortion, const Eigen::Vector3d& imagePoint);

/// The inverse of undistort: where a camera with radial distortion sees what a pinhole camera sees at an image point,
///
///     (u, v) -> s (u, v),   s = 2 / (1 + sqrt(1 - 4 distortion (u^2 + v^2))).
///
/// \return (u', v', 1); empty where there is none, 4 distortion (u^2 + v^2) >= 1, or anything is not finite
HYBRIDGV_EXPORT std::optional<Eigen::Vector3d> distort(double distortion, const Eigen::Vector3d& imagePoint);

/// COLMAP's camera model SIMPLE_RADIAL without its principal point: a point (x, y, 1) of the camera's frame is seen at
/// focalLength (1 + k1 r^2) (x, y), r^2 = x^2 + y^2.
struct SimpleRadial {
  double focalLength = 0;  ///< [px]
  double k1 = 0;           ///< negative: barrel distortion
};

/// The SIMPLE_RADIAL model that is nearest to a division model where image points are: focalLength f' and k1 with the least sum of
///
///     (r - f' x - f' k1 x^3)^2,   x = r / (1 + distortion r^2) / focalLength.
///
/// For small distortion k1 is about distortion * focalLength^2. Where it is strong the focal lengths of the two models differ, by
/// 0.6 % for k1 = -0.2 in an image that is as wide as 1.4 focal lengths; each is right for its model.
///
/// \param focalLength  of the division model [px]
/// \param distortion   of the division model [1/px^2]
/// \param radii        r, distances of image points from the principal point [px]. The model is best where they are.
/// \return (focalLength, 0) if there is no distortion or the radii do not determine k1: fewer than two different ones, one with
///         1 + distortion r^2 <= 0, one that is not finite
/// \throws std::invalid_argument for a focal length that is not positive and finite, a distortion that is not finite
HYBRIDGV_EXPORT SimpleRadial toSimpleRadial(double focalLength, double distortion, const std::vector<double>& radii);

}  // namespace hybridgv
