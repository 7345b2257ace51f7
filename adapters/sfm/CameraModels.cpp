#include "CameraModels.hpp"

#include <algorithm>
#include <cmath>

#include "CheckArguments.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

struct Entry {
  CameraModel model;
  const char* name;
  std::size_t parameters;
  std::size_t focalLengths;  // how many of them come first
};

// In the order of COLMAP's numbers, then those that COLMAP does not have.
constexpr Entry kModels[] = {
    {CameraModel::SimplePinhole, "SIMPLE_PINHOLE", 3, 1},
    {CameraModel::Pinhole, "PINHOLE", 4, 2},
    {CameraModel::SimpleRadial, "SIMPLE_RADIAL", 4, 1},
    {CameraModel::Radial, "RADIAL", 5, 1},
    {CameraModel::OpenCV, "OPENCV", 8, 2},
    {CameraModel::OpenCVFisheye, "OPENCV_FISHEYE", 8, 2},
    {CameraModel::FullOpenCV, "FULL_OPENCV", 12, 2},
    {CameraModel::Fov, "FOV", 5, 2},
    {CameraModel::SimpleRadialFisheye, "SIMPLE_RADIAL_FISHEYE", 4, 1},
    {CameraModel::RadialFisheye, "RADIAL_FISHEYE", 5, 1},
    {CameraModel::ThinPrismFisheye, "THIN_PRISM_FISHEYE", 12, 2},
    {CameraModel::RadTanThinPrismFisheye, "RAD_TAN_THIN_PRISM_FISHEYE", 16, 2},
    {CameraModel::SimpleDivision, "SIMPLE_DIVISION", 4, 1},
    {CameraModel::Division, "DIVISION", 5, 2},
    {CameraModel::SimpleFisheye, "SIMPLE_FISHEYE", 3, 1},
    {CameraModel::Fisheye, "FISHEYE", 4, 2},
    {CameraModel::Eucm, "EUCM", 6, 2},
    {CameraModel::Equirectangular, "EQUIRECTANGULAR", 2, 0},
    {CameraModel::NvmRadial, "NVM_RADIAL", 5, 2},
};
constexpr std::int64_t kColmapCount = 18;

const Entry* find(CameraModel model) {
  const auto entry = std::find_if(std::begin(kModels), std::end(kModels), [&](const Entry& e) { return e.model == model; });
  return entry == std::end(kModels) ? nullptr : entry;
}

}  // namespace

const char* toString(CameraModel model) {
  if (model == CameraModel::Unknown) return "UNKNOWN";
  if (const Entry* entry = find(model)) return entry->name;
  throwInvalid("model", "no such camera model: " + std::to_string(static_cast<int>(model)));
}

CameraModel colmapModelFromName(std::string_view name) {
  for (std::int64_t i = 0; i < kColmapCount; ++i)
    if (name == kModels[i].name) return kModels[i].model;
  return CameraModel::Unknown;
}

CameraModel colmapModelFromNumber(std::int64_t number) {
  return number >= 0 && number < kColmapCount ? kModels[number].model : CameraModel::Unknown;
}

std::int32_t colmapNumber(CameraModel model) { return static_cast<std::int32_t>(model); }

std::size_t parameterCount(CameraModel model) {
  const Entry* entry = find(model);
  return entry == nullptr ? 0 : entry->parameters;
}

std::size_t focalLengthCount(CameraModel model) {
  const Entry* entry = find(model);
  return entry == nullptr ? 0 : entry->focalLengths;
}

bool mapsAPlane(CameraModel model) {
  switch (model) {
    case CameraModel::SimplePinhole:
    case CameraModel::Pinhole:
    case CameraModel::SimpleRadial:
    case CameraModel::Radial:
    case CameraModel::OpenCV:
    case CameraModel::FullOpenCV:
    case CameraModel::NvmRadial:
      return true;
    default:
      return false;
  }
}

static std::string findParameterFault(const Camera& camera) {
  const std::vector<double>& p = camera.parameters;
  if (camera.model == CameraModel::Equirectangular)
    return p[0] > 0 && p[1] > 0 ? "" : "the size of the panorama must be positive, is " + detail::format(std::min(p[0], p[1]));
  const double smallest = focalLengthCount(camera.model) == 2 ? std::min(p[0], p[1]) : p[0];
  if (!(smallest > 0)) return "the focal length must be positive, is " + detail::format(smallest);
  if (camera.model == CameraModel::Fov && !(std::abs(p[4]) < std::acos(-1.0)))
    return "the angle of FOV must be smaller than pi, is " + detail::format(p[4]);
  if (camera.model == CameraModel::Eucm && !(p[4] >= 0 && p[4] <= 1 && p[5] > 0))
    return "EUCM wants alpha in 0 .. 1 and beta > 0, got " + detail::format(p[4]) + " and " + detail::format(p[5]);
  return {};
}

std::string findCameraFault(const Camera& camera) {
  if (camera.model == CameraModel::Unknown) return "its camera model is not known";
  const std::size_t count = parameterCount(camera.model);
  if (camera.parameters.size() != count)
    return std::string("model ") + toString(camera.model) + " has " + std::to_string(count) + " parameters, got " +
           std::to_string(camera.parameters.size());
  for (const double value : camera.parameters)
    if (!std::isfinite(value)) return "the parameters must be finite, one is " + detail::format(value);
  return findParameterFault(camera);
}

Camera asColmapCamera(const Camera& camera) {
  const std::string fault = findCameraFault(camera);
  if (!fault.empty()) throwInvalid("camera " + std::to_string(camera.id), fault);
  if (camera.model != CameraModel::NvmRadial) return camera;
  if (camera.parameters[4] != 0)
    throwInvalid("camera " + std::to_string(camera.id), "COLMAP has no camera model for VisualSFM's radial distortion");
  Camera result = camera;
  result.model = CameraModel::Pinhole;
  result.parameters.resize(4);
  return result;
}

}  // namespace sfm
}  // namespace hybridgv
