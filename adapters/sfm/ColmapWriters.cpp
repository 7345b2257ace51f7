#include "ByteWriter.hpp"
#include "ColmapPose.hpp"
#include "FolderReplacement.hpp"
#include "ModelChecks.hpp"
#include "NumberWriter.hpp"
#include "RigFiles.hpp"
#include "WrittenParts.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {

void writeColmapText(const std::string& folder, const SparseModel& model) {
  checkModel(model);
  const WrittenParts parts(model, WrittenParts::Format::Text);
  FolderReplacement files(folder);
  std::string text = "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n";
  for (const Camera& camera : parts.cameras()) {
    appendNumber(text, camera.id);
    text += " " + WrittenParts::modelName(camera);
    appendNumbers(text, std::array<std::uint64_t, 2>{camera.width, camera.height});
    appendNumbers(text, camera.parameters);
    text += '\n';
  }
  files.write("cameras.txt", text);

  text = "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as (X Y POINT3D_ID)\n";
  for (const Image* image : parts.images()) {
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
  files.write("images.txt", text);

  text = "# POINT3D_ID X Y Z R G B ERROR TRACK[] as (IMAGE_ID POINT2D_IDX)\n";
  for (const Point& point : model.points) {
    appendNumber(text, point.id);
    appendNumbers(text, point.position);
    for (const std::uint8_t channel : point.colour) appendNumber(text, static_cast<int>(channel));
    appendNumber(text, point.error);
    for (const TrackElement& e : parts.track(point))
      appendNumbers(text, std::array<std::uint64_t, 2>{model.images[e.image].id, e.observation});
    text += '\n';
  }
  files.write("points3D.txt", text);
  writeRigsText(parts, files);
  files.commit();
}

void writeColmapBinary(const std::string& folder, const SparseModel& model) {
  checkModel(model);
  const WrittenParts parts(model, WrittenParts::Format::Binary);
  FolderReplacement files(folder);
  std::string bytes;
  putInteger(bytes, parts.cameras().size(), 8);
  for (const Camera& camera : parts.cameras()) {
    putInteger(bytes, camera.id, 4);
    putInteger(bytes, static_cast<std::uint32_t>(WrittenParts::modelNumber(camera)), 4);
    putInteger(bytes, camera.width, 8);
    putInteger(bytes, camera.height, 8);
    for (const double value : camera.parameters) putNumber(bytes, value);
  }
  files.write("cameras.bin", bytes);

  bytes.clear();
  putInteger(bytes, parts.images().size(), 8);
  for (const Image* image : parts.images()) {
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
  files.write("images.bin", bytes);

  bytes.clear();
  putInteger(bytes, model.points.size(), 8);
  for (const Point& point : model.points) {
    putInteger(bytes, point.id, 8);
    for (const double value : point.position) putNumber(bytes, value);
    for (const std::uint8_t channel : point.colour) putInteger(bytes, channel, 1);
    putNumber(bytes, point.error);
    const std::vector<TrackElement> track = parts.track(point);
    putInteger(bytes, track.size(), 8);
    for (const TrackElement& e : track) {
      putInteger(bytes, model.images[e.image].id, 4);
      putInteger(bytes, e.observation, 4);
    }
  }
  files.write("points3D.bin", bytes);
  writeRigsBinary(parts, files);
  files.commit();
}

}  // namespace sfm
}  // namespace hybridgv
