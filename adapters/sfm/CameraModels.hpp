// The table of camera models: COLMAP's names and numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "hybridgv/adapters/sfm/Camera.hpp"

namespace hybridgv {
namespace sfm {

// CameraModel::Unknown if there is none.
CameraModel colmapModelFromName(std::string_view name);
CameraModel colmapModelFromNumber(std::int64_t number);
// Of one of COLMAP's models.
std::int32_t colmapNumber(CameraModel model);

// Number of entries of Camera::parameters.
std::size_t parameterCount(CameraModel model);

// How many focal lengths these start with: 1, 2, or none for a panorama. The principal point follows.
std::size_t focalLengthCount(CameraModel model);

// True for the pinhole with or without distortion of its image plane; false where the formula starts from angles or the sphere.
bool mapsAPlane(CameraModel model);

// Empty if the camera is usable, otherwise what is wrong with it.
std::string findCameraFault(const Camera& camera);

// The camera as COLMAP can describe it; std::invalid_argument for NvmRadial with distortion, or a camera that is not usable.
Camera asColmapCamera(const Camera& camera);

}  // namespace sfm
}  // namespace hybridgv
