// COLMAP's numbering of camera models.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hybridgv/adapters/sfm/Camera.hpp"

namespace hybridgv {
namespace sfm {

// Empty, or what is wrong: the model, by name, is not one of those supported.
std::string colmapModelFromName(std::string_view name, CameraModel& model);
std::string colmapModelFromNumber(std::int64_t number, CameraModel& model);

std::int32_t colmapNumber(CameraModel model);

// The camera as COLMAP can describe it; std::invalid_argument for NvmRadial with distortion.
Camera asColmapCamera(const Camera& camera);

}  // namespace sfm
}  // namespace hybridgv
