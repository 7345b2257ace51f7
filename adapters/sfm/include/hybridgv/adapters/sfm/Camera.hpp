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

/// How a point (X, Y, Z) of the camera's frame becomes a pixel, (fx u + cx, fy v + cy). The parameters stand in the order of the
/// COLMAP files; where there is one focal length f, fx = fy = f. With
///
///     (x, y) = (X/Z, Y/Z),  r^2 = x^2 + y^2        for Z > 0
///     (a, b) = theta (X, Y) / |(X, Y)|,  theta = atan2(|(X, Y)|, Z) in 0 .. pi, the angle to the axis
///
/// | model                     | (u, v) |
/// |---------------------------|--------|
/// | pinhole                   | (x, y) |
/// | radial                    | (1 + k1 r^2 + k2 r^4) (x, y) |
/// | OpenCV                    | the same plus (2 p1 x y + p2 (r^2 + 2 x^2),  2 p2 x y + p1 (r^2 + 2 y^2)) |
/// | FullOpenCV                | (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6) (x, y) plus the same terms |
/// | fisheye                   | (1 + k1 theta^2 + k2 theta^4 + ..) (a, b) |
/// | ThinPrismFisheye          | the same, with OpenCV's terms in (a, b), plus (sx1 theta^2, sy1 theta^2) |
/// | RadTanThinPrismFisheye    | (c, d) = (1 + k0 theta^2 + k1 theta^4 + ..) (a, b), q = c^2 + d^2: (c, d) plus (2 p1 c d + p0 (q + 2 c^2) + s0 q + s1 q^2,  2 p0 c d + p1 (q + 2 d^2) + s2 q + s3 q^2) |
/// | Fov                       | atan(2 r tan(w/2)) / (r w) (x, y) |
/// | division                  | 2 / (Z + sqrt(Z^2 - 4 k (X^2 + Y^2))) (X, Y); (x, y) = (u, v) / (1 + k (u^2 + v^2)) |
/// | Eucm                      | (X, Y) / (alpha sqrt(beta (X^2 + Y^2) + Z^2) + (1 - alpha) Z) |
/// | Equirectangular           | the pixel itself is ((atan2(X, Z) / (2 pi) + 1/2) w,  (1/2 - atan2(-Y, |(X, Z)|) / pi) h) |
/// | NvmRadial                 | (x, y) = (1 + k (u^2 + v^2)) (u, v): the formula *removes* the distortion |
///
/// Sources: COLMAP (src/colmap/sensor/models.h up to 4.1); VisualSFM's documentation of NVM_V3. Values below NvmRadial are
/// COLMAP's numbers.
enum class CameraModel {
  SimplePinhole = 0,            ///< f, cx, cy
  Pinhole = 1,                  ///< fx, fy, cx, cy
  SimpleRadial = 2,             ///< f, cx, cy, k1
  Radial = 3,                   ///< f, cx, cy, k1, k2 (also the model of Bundler, with cx = cy = 0)
  OpenCV = 4,                   ///< fx, fy, cx, cy, k1, k2, p1, p2
  OpenCVFisheye = 5,            ///< fx, fy, cx, cy, k1, k2, k3, k4
  FullOpenCV = 6,               ///< fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6
  Fov = 7,                      ///< fx, fy, cx, cy, w
  SimpleRadialFisheye = 8,      ///< f, cx, cy, k1
  RadialFisheye = 9,            ///< f, cx, cy, k1, k2
  ThinPrismFisheye = 10,        ///< fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, sx1, sy1
  RadTanThinPrismFisheye = 11,  ///< fx, fy, cx, cy, k0, .., k5, p0, p1, s0, s1, s2, s3
  SimpleDivision = 12,          ///< f, cx, cy, k
  Division = 13,                ///< fx, fy, cx, cy, k
  SimpleFisheye = 14,           ///< f, cx, cy
  Fisheye = 15,                 ///< fx, fy, cx, cy
  Eucm = 16,                    ///< fx, fy, cx, cy, alpha, beta
  Equirectangular = 17,         ///< w, h: a panorama of the whole sphere
  NvmRadial = 1000,             ///< fx, fy, cx, cy, k (of VisualSFM, with cx = cy = 0)
  Unknown = 1001,               ///< a model newer than this list: the camera can be kept, not used
};

/// COLMAP's name of the model ("SIMPLE_RADIAL"); "NVM_RADIAL" for NvmRadial, which COLMAP does not have, "UNKNOWN" for Unknown.
HYBRIDGV_EXPORT const char* toString(CameraModel model);

/// False for Equirectangular (and Unknown): undistort() and distort() refuse such cameras, bearingVector() and project() serve them.
HYBRIDGV_EXPORT bool hasImagePlane(CameraModel model);

/// The intrinsic parameters shared by one or more images.
struct Camera {
  std::uint32_t id = 0;                            ///< the number in the file
  CameraModel model = CameraModel::SimplePinhole;  ///< what the parameters mean
  std::uint64_t width = 0;                         ///< [px], 0 = unknown (Bundler, NVM)
  std::uint64_t height = 0;                        ///< [px], 0 = unknown (Bundler, NVM)
  std::vector<double> parameters;                  ///< in the order given at CameraModel
  std::string unknownModel = {};                   ///< of model Unknown: its name (text) or number (binary) in the file
};

/// fx [px]: the focal length to which the image points of undistort() belong, and the pixels per radian on the axis; for a panorama
/// w / (2 pi).
/// \throws std::invalid_argument as undistort()
HYBRIDGV_EXPORT double focalLength(const Camera& camera);

/// The viewing ray of a pixel in the camera's frame, for every camera model.
///
/// \param x, y  pixel as stored in the map [px]
/// \return unit length, any direction (fisheye cameras and panoramas see behind themselves); empty if the pixel is the image of
///         nothing: beyond the largest radius up to which the formula grows, beyond 180 degrees, outside a panorama. Where two
///         rays have the same pixel, the one inside that radius is returned. project() gives the pixel back to 1e-12 * fx.
/// \throws std::invalid_argument for a wrong number of parameters, a focal length that is not positive, values that are not
///         finite, an unknown model
HYBRIDGV_EXPORT std::optional<Eigen::Vector3d> bearingVector(const Camera& camera, double x, double y);

/// The inverse of bearingVector().
/// \param point  in the camera's frame, of any length (only its direction matters)
/// \return the pixel (x, y, 1); empty if the camera cannot see in that direction
/// \throws std::invalid_argument as bearingVector()
HYBRIDGV_EXPORT std::optional<Eigen::Vector3d> project(const Camera& camera, const Eigen::Vector3d& point);

/// Removes the lens distortion, the principal point and the pixels' aspect ratio.
///
/// \param x, y  pixel as stored in the map [px]
/// \return (u, v, 1) with (u, v) = fx * (X/Z, Y/Z) for the point (X, Y, Z) seen there: undistorted pixels relative to the
///         principal point. Where fy differs from fx, v is stretched by fx/fy, so that pixels are square and fx is the one focal
///         length. Empty if there is no such point: a distortion with k1 < 0 maps the ring of radius r_max (where the distorted
///         radius stops to grow) farthest out, and a pixel beyond its image is the image of nothing. Of several points that the
///         formula maps onto the same pixel, the one inside r_max is returned. Empty too where a fisheye camera looks sideways
///         or behind itself (Z <= 0). The result satisfies the equation above to 1e-12 * fx.
/// \throws std::invalid_argument for a wrong number of parameters, a focal length that is not positive, values that are not
///         finite, a model that has no image plane
HYBRIDGV_EXPORT std::optional<Eigen::Vector3d> undistort(const Camera& camera, double x, double y);

/// The inverse of undistort().
/// \param imagePoint  (u, v, 1)
/// \return the pixel (x, y, 1); empty outside r_max, where the formula does not describe the lens any more
/// \throws std::invalid_argument as undistort()
HYBRIDGV_EXPORT std::optional<Eigen::Vector3d> distort(const Camera& camera, const Eigen::Vector3d& imagePoint);

}  // namespace sfm
}  // namespace hybridgv
