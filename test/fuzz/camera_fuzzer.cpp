// Camera models: one byte is the model, doubles are a pixel and the parameters.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "CameraModels.hpp"
#include "ReaderFuzzer.hpp"
#include "hybridgv/adapters/sfm/Camera.hpp"

namespace {

using namespace hybridgv;

void checkPixel(const sfm::Camera& camera, double x, double y) {
  const auto ray = sfm::bearingVector(camera, x, y);
  if (!ray) return;
  if (!(std::abs(ray->norm() - 1) < 1e-9)) fuzz::reportFault("a viewing ray has unit length");
  const auto pixel = sfm::project(camera, *ray);
  if (pixel && !pixel->allFinite()) fuzz::reportFault("a pixel is finite");
}

void checkPlane(const sfm::Camera& camera, double x, double y) {
  const auto point = sfm::undistort(camera, x, y);
  if (!point) return;
  if (!point->allFinite()) fuzz::reportFault("an undistorted point is finite");
  const auto pixel = sfm::distort(camera, *point);
  if (pixel && !pixel->allFinite()) fuzz::reportFault("a distorted point is finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  sfm::Camera camera;
  const int models = static_cast<int>(sfm::CameraModel::Equirectangular) + 1;
  camera.model = static_cast<sfm::CameraModel>(data[0] % models);
  camera.width = 1000;
  camera.height = 800;
  std::vector<double> values(2 + sfm::parameterCount(camera.model));
  std::memcpy(values.data(), data + 1, std::min(size - 1, sizeof(double) * values.size()));
  camera.parameters.assign(values.begin() + 2, values.end());
  const bool isUsable = sfm::findCameraFault(camera).empty() && std::isfinite(values[0]) && std::isfinite(values[1]);
  if (!isUsable) return 0;
  checkPixel(camera, values[0], values[1]);
  if (sfm::hasImagePlane(camera.model)) checkPlane(camera, values[0], values[1]);
  return 0;
}
