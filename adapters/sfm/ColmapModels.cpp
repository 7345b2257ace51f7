#include "ColmapModels.hpp"

#include "CameraChecks.hpp"
#include "CheckArguments.hpp"
#include "Printable.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The numbers 0 .. 4 are the values of CameraModel.
constexpr CameraModel kSupported[] = {CameraModel::SimplePinhole, CameraModel::Pinhole, CameraModel::SimpleRadial,
                                      CameraModel::Radial, CameraModel::OpenCV};
// The following ones, to name them in messages.
constexpr const char* kOther[] = {"OPENCV_FISHEYE",        "FULL_OPENCV",    "FOV",
                                  "SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE", "THIN_PRISM_FISHEYE"};
constexpr std::int64_t kSupportedCount = sizeof kSupported / sizeof *kSupported;
constexpr std::int64_t kOtherCount = sizeof kOther / sizeof *kOther;

std::string unsupported(const std::string& name) {
  std::string result = "the camera model " + name + " is not supported; supported are";
  for (const CameraModel model : kSupported) result += std::string(" ") + toString(model);
  return result;
}

}  // namespace

std::string colmapModelFromName(std::string_view name, CameraModel& model) {
  for (const CameraModel candidate : kSupported)
    if (name == toString(candidate)) {
      model = candidate;
      return {};
    }
  return unsupported("'" + printable(name) + "'");
}

std::string colmapModelFromNumber(std::int64_t number, CameraModel& model) {
  if (number >= 0 && number < kSupportedCount) {
    model = kSupported[number];
    return {};
  }
  const std::int64_t other = number - kSupportedCount;
  return unsupported(other >= 0 && other < kOtherCount ? kOther[other] : "number " + std::to_string(number));
}

std::int32_t colmapNumber(CameraModel model) { return static_cast<std::int32_t>(model); }

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
