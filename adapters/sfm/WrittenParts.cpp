#include "WrittenParts.hpp"

#include <algorithm>
#include <charconv>

#include "CameraModels.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The number that `text` is, if it is one and nothing else.
bool isModelNumber(const std::string& text, std::int32_t& number) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

bool canCarry(const Camera& camera, WrittenParts::Format format) {
  if (camera.model == CameraModel::NvmRadial) return false;
  if (camera.model != CameraModel::Unknown) return camera.parameters.size() == parameterCount(camera.model);
  std::int32_t number = 0;
  const bool isNumber = isModelNumber(camera.unknownModel, number);
  return isNumber == (format == WrittenParts::Format::Binary) && !camera.unknownModel.empty();
}

}  // namespace

WrittenParts::WrittenParts(const SparseModel& model, Format format) : model_(model), isImageWritten_(model.images.size()) {
  enum class Use { None, LeftOut, Carried, Registered };
  std::vector<Use> uses(model.cameras.size(), Use::None);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const Image& image = model.images[i];
    Use use = image.registered ? Use::Registered : Use::LeftOut;
    if (image.carried && !image.registered && canCarry(model.cameras[image.camera], format)) use = Use::Carried;
    uses[image.camera] = std::max(uses[image.camera], use);
    isImageWritten_[i] = use == Use::LeftOut ? 0 : 1;
    if (use != Use::LeftOut) images_.push_back(&image);
  }
  for (std::size_t i = 0; i < model.cameras.size(); ++i) {
    const Camera& camera = model.cameras[i];
    const bool isSensible = findCameraFault(camera).empty();
    const bool isUnknown = camera.model == CameraModel::Unknown && canCarry(camera, format);
    if (uses[i] == Use::Registered || (isSensible && uses[i] != Use::LeftOut))
      cameras_.push_back(asColmapCamera(camera));
    else if (uses[i] == Use::Carried || (uses[i] == Use::None && isUnknown))
      cameras_.push_back(camera);
  }
}

std::vector<TrackElement> WrittenParts::track(const Point& point) const {
  std::vector<TrackElement> result;
  for (const TrackElement& e : point.track)
    if (hasImage(e.image)) result.push_back(e);
  return result;
}

std::int32_t WrittenParts::modelNumber(const Camera& camera) {
  std::int32_t number = 0;
  if (camera.model == CameraModel::Unknown && isModelNumber(camera.unknownModel, number)) return number;
  return colmapNumber(camera.model);
}

std::string WrittenParts::modelName(const Camera& camera) {
  return camera.model == CameraModel::Unknown ? camera.unknownModel : toString(camera.model);
}

}  // namespace sfm
}  // namespace hybridgv
