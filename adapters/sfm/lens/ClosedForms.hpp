// The camera models whose formulas can be inverted by hand. Images are those before focal lengths and principal point; the
// equations stand at CameraModel.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace hybridgv {
namespace sfm {

using MaybeImage = std::optional<Eigen::Vector2d>;
using MaybeRay = std::optional<Eigen::Vector3d>;  // of any length

MaybeImage equidistantImage(const Eigen::Vector3d& point);
MaybeRay equidistantRay(const Eigen::Vector2d& image);

MaybeImage fovImage(const Eigen::Vector3d& point, double angle);
MaybeRay fovRay(const Eigen::Vector2d& image, double angle);

MaybeImage divisionImage(const Eigen::Vector3d& point, double k);
MaybeRay divisionRay(const Eigen::Vector2d& image, double k);

MaybeImage eucmImage(const Eigen::Vector3d& point, double alpha, double beta);
MaybeRay eucmRay(const Eigen::Vector2d& image, double alpha, double beta);

// Longitude and latitude [rad]; to the right and downwards.
MaybeImage sphereImage(const Eigen::Vector3d& point);
MaybeRay sphereRay(const Eigen::Vector2d& image);

}  // namespace sfm
}  // namespace hybridgv
