// What the readers and the distortion functions demand of a camera.
#pragma once

#include <cstddef>
#include <string>

#include "hybridgv/adapters/sfm/Camera.hpp"

namespace hybridgv {
namespace sfm {

// Number of entries of Camera::parameters.
std::size_t parameterCount(CameraModel model);

// Empty if the camera is usable, otherwise what is wrong with it.
std::string findCameraFault(const Camera& camera);

}  // namespace sfm
}  // namespace hybridgv
