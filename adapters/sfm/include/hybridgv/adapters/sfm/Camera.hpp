/// \file
/// \brief Camera models of the maps on disk, and lens distortion.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// A point (x, y, z) in front of the camera is seen at the pixel
///
///     (fx * d(x/z, y/z).x + cx,  fy * d(x/z, y/z).y + cy)
///
/// with the distortion d of the model. With r^2 = x^2 + y^2:
///
/// * radial:  d(x, y) = (1 + k1 r^2 + k2 r^4) (x, y)
/// * OpenCV:  the same plus (2 p1 x y + p2 (r^2 + 2 x^2),  p1 (r^2 + 2 y^2) + 2 p2 x y)
/// * NVM:     (x, y) = (1 + k |d|^2) d: the formula *removes* the distortion
///
/// The parameters stand in the order of the COLMAP files.
enum class CameraModel {
  SimplePinhole,  ///< f, cx, cy
  Pinhole,        ///< fx, fy, cx, cy
  SimpleRadial,   ///< f, cx, cy, k1
  Radial,         ///< f, cx, cy, k1, k2 (also the model of Bundler, with cx = cy = 0)
  OpenCV,         ///< fx, fy, cx, cy, k1, k2, p1, p2
  NvmRadial,      ///< fx, fy, cx, cy, k (of VisualSFM, with cx = cy = 0)
};

/// COLMAP's name of the model ("SIMPLE_RADIAL"); "NVM_RADIAL" for NvmRadial, which COLMAP does not know.
HYBRIDGV_EXPORT const char* toString(CameraModel model);

/// The intrinsic parameters shared by one or more images.
struct Camera {
  std::uint32_t id = 0;                            ///< the number in the file
  CameraModel model = CameraModel::SimplePinhole;  ///< what the parameters mean
  std::uint64_t width = 0;                         ///< [px], 0 = unknown (Bundler, NVM)
  std::uint64_t height = 0;                        ///< [px], likewise
  std::vector<double> parameters;                  ///< in the order given at CameraModel
};

/// fx [px]: the focal length to which the image points of undistort() belong.
HYBRIDGV_EXPORT double focalLength(const Camera& camera);

/// Removes the lens distortion, the principal point and the pixels' aspect ratio.
///
/// \param x, y  pixel as stored in the map [px]
/// \return (u, v, 1) with (u, v) = fx * (X/Z, Y/Z) for the point (X, Y, Z) seen there: undistorted pixels relative to the
///         principal point. Where fy differs from fx, v is stretched by fx/fy, so that pixels are square and fx is the one focal
///         length. Empty if there is no such point: a distortion with k1 < 0 maps the ring of radius r_max (where the distorted
///         radius stops to grow) farthest out, and a pixel beyond its image is the image of nothing. Of several points that the
///         formula maps onto the same pixel, the one inside r_max is returned. The result satisfies the equation above to
///         1e-12 * fx.
/// \throws std::invalid_argument for a wrong number of parameters, a focal length that is not positive, values that are not
///         finite
HYBRIDGV_EXPORT std::optional<Eigen::Vector3d> undistort(const Camera& camera, double x, double y);

/// The inverse of undistort().
/// \param imagePoint  (u, v, 1)
/// \return the pixel (x, y, 1); empty outside r_max, where the formula does not describe the lens any more
/// \throws std::invalid_argument as undistort()
HYBRIDGV_EXPORT std::optional<Eigen::Vector3d> distort(const Camera& camera, const Eigen::Vector3d& imagePoint);

}  // namespace sfm
}  // namespace hybridgv
