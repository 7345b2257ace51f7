#include <algorithm>

#include "ByteWriter.hpp"
#include "CameraModels.hpp"
#include "ColmapPose.hpp"
#include "FileContents.hpp"
#include "ModelChecks.hpp"
#include "NumberWriter.hpp"
#include "RigFiles.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The cameras in COLMAP's terms, but those that only images without registration have, or that no image has and that make no
// sense.
std::vector<Camera> colmapCameras(const SparseModel& model) {
  std::vector<bool> wanted;
  for (const Camera& camera : model.cameras) wanted.push_back(findCameraFault(camera).empty());
  for (const Image& image : model.images)
    if (!image.registered) wanted[image.camera] = false;
  for (const Image& image : model.images)
    if (image.registered) wanted[image.camera] = true;
  std::vector<Camera> result;
  for (std::size_t i = 0; i < model.cameras.size(); ++i)
    if (wanted[i]) result.push_back(asColmapCamera(model.cameras[i]));
  return result;
}

std::vector<const Image*> registeredImages(const SparseModel& model) {
  std::vector<const Image*> result;
  for (const Image& image : model.images)
    if (image.registered) result.push_back(&image);
  return result;
}

}  // namespace

void writeColmapText(const std::string& folder, const SparseModel& model) {
  checkModel(model);
  std::string text = "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n";
  for (const Camera& camera : colmapCameras(model)) {
    appendNumber(text, camera.id);
    text += std::string(" ") + toString(camera.model);
    appendNumbers(text, std::array<std::uint64_t, 2>{camera.width, camera.height});
    appendNumbers(text, camera.parameters);
    text += '\n';
  }
  writeFile(joinPath(folder, "cameras.txt"), text);

  text = "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as (X Y POINT3D_ID)\n";
  for (const Image* image : registeredImages(model)) {
    appendNumber(text, image->id);
    appendNumbers(text, colmapPose(*image));
    appendNumber(text, model.cameras[image->camera].id);
    text += ' ' + image->name + '\n';
    for (const Observation& o : image->observations) {
      appendNumbers(text, std::array<double, 2>{o.x, o.y});
      if (o.point == Observation::kNoPoint)
        text += " -1";
      else
        appendNumber(text, model.points[o.point].id);
    }
    text += '\n';
  }
  writeFile(joinPath(folder, "images.txt"), text);

  text = "# POINT3D_ID X Y Z R G B ERROR TRACK[] as (IMAGE_ID POINT2D_IDX)\n";
  for (const Point& point : model.points) {
    appendNumber(text, point.id);
    appendNumbers(text, point.position);
    for (const std::uint8_t channel : point.colour) appendNumber(text, static_cast<int>(channel));
    appendNumber(text, point.error);
    for (const TrackElement& e : point.track)
      appendNumbers(text, std::array<std::uint64_t, 2>{model.images[e.image].id, e.observation});
    text += '\n';
  }
  writeFile(joinPath(folder, "points3D.txt"), text);
  writeRigsText(folder, model);
}

void writeColmapBinary(const std::string& folder, const SparseModel& model) {
  checkModel(model);
  std::string bytes;
  const std::vector<Camera> cameras = colmapCameras(model);
  putInteger(bytes, cameras.size(), 8);
  for (const Camera& camera : cameras) {
    putInteger(bytes, camera.id, 4);
    putInteger(bytes, static_cast<std::uint32_t>(colmapNumber(camera.model)), 4);
    putInteger(bytes, camera.width, 8);
    putInteger(bytes, camera.height, 8);
    for (const double value : camera.parameters) putNumber(bytes, value);
  }
  writeFile(joinPath(folder, "cameras.bin"), bytes);

  bytes.clear();
  const std::vector<const Image*> images = registeredImages(model);
  putInteger(bytes, images.size(), 8);
  for (const Image* image : images) {
    putInteger(bytes, image->id, 4);
    for (const double value : colmapPose(*image)) putNumber(bytes, value);
    putInteger(bytes, model.cameras[image->camera].id, 4);
    bytes.append(image->name.c_str(), image->name.size() + 1);
    putInteger(bytes, image->observations.size(), 8);
    for (const Observation& o : image->observations) {
      putNumber(bytes, o.x);
      putNumber(bytes, o.y);
      putInteger(bytes, o.point == Observation::kNoPoint ? ~std::uint64_t{0} : model.points[o.point].id, 8);
    }
  }
  writeFile(joinPath(folder, "images.bin"), bytes);

  bytes.clear();
  putInteger(bytes, model.points.size(), 8);
  for (const Point& point : model.points) {
    putInteger(bytes, point.id, 8);
    for (const double value : point.position) putNumber(bytes, value);
    for (const std::uint8_t channel : point.colour) putInteger(bytes, channel, 1);
    putNumber(bytes, point.error);
    putInteger(bytes, point.track.size(), 8);
    for (const TrackElement& e : point.track) {
      putInteger(bytes, model.images[e.image].id, 4);
      putInteger(bytes, e.observation, 4);
    }
  }
  writeFile(joinPath(folder, "points3D.bin"), bytes);
  writeRigsBinary(folder, model);
}

}  // namespace sfm
}  // namespace hybridgv
