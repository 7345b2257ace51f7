#include "ModelChecks.hpp"

#include <cmath>
#include <string>

#include "CheckArguments.hpp"
#include "ModelLinks.hpp"
#include "hybridgv/detail/format.hpp"
#include "imageName.hpp"

namespace hybridgv {
namespace sfm {
namespace {

std::string element(const char* list, std::size_t index) {
  return std::string("model.") + list + "[" + std::to_string(index) + "]";
}

template <class Things>
void checkIds(const Things& things, const char* list, const char* kind) {
  IdIndex ids(kind);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::string fault = ids.add(things[i].id, i);
    if (!fault.empty()) throwInvalid(element(list, i), fault);
  }
}

void checkImage(const SparseModel& model, std::size_t index) {
  const Image& image = model.images[index];
  const std::string name = element("images", index);
  if (image.camera >= model.cameras.size()) throwInvalid(name, "there is no camera with index " + std::to_string(image.camera));
  if (image.name.empty()) throwInvalid(name, "has no name");
  if (!isUsableName(image.name)) throwInvalid(name, "the name contains a line break or a zero byte");
  if (!image.rotation.allFinite() || !image.position.allFinite())
    throwInvalid(name, "the pose must be finite, its position is " + detail::format(image.position) + ", its rotation " +
                           detail::format(image.rotation));
  for (const Observation& o : image.observations) {
    if (!std::isfinite(o.x) || !std::isfinite(o.y))
      throwInvalid(name, "an observation must be finite, is (" + detail::format(o.x) + ", " + detail::format(o.y) + ")");
    if (o.point != Observation::kNoPoint && o.point >= model.points.size())
      throwInvalid(name, "there is no point with index " + std::to_string(o.point));
  }
}

void checkPoint(const SparseModel& model, std::size_t index) {
  const Point& point = model.points[index];
  const std::string name = element("points", index);
  if (!point.position.allFinite() || !std::isfinite(point.error))
    throwInvalid(
        name, "must be finite, its position is " + detail::format(point.position) + ", its error " + detail::format(point.error));
  for (const TrackElement& e : point.track) {
    if (e.image >= model.images.size() || e.observation >= model.images[e.image].observations.size())
      throwInvalid(name, "the track names an observation that does not exist");
    if (model.images[e.image].observations[e.observation].point != index)
      throwInvalid(name, "the track names an observation of another point");
    if (!model.images[e.image].registered && !model.images[e.image].carried)
      throwInvalid(name, "the track names an image that is not registered");
  }
}

}  // namespace

void checkModel(const SparseModel& model) {
  checkIds(model.cameras, "cameras", "camera");
  checkIds(model.images, "images", "image");
  checkIds(model.points, "points", "point");
  checkIds(model.rigs, "rigs", "rig");
  checkIds(model.frames, "frames", "frame");
  for (std::size_t i = 0; i < model.images.size(); ++i) checkImage(model, i);
  for (std::size_t i = 0; i < model.points.size(); ++i) checkPoint(model, i);
}

}  // namespace sfm
}  // namespace hybridgv
