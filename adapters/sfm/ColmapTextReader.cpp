#include "CameraModels.hpp"
#include "FileContents.hpp"
#include "ModelLinks.hpp"
#include "Printable.hpp"
#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

void check(const TextScanner& in, const std::string& fault) {
  if (!fault.empty()) in.fail(fault);
}

Eigen::Vector3d readVector(TextScanner& in, const char* what) {
  const double x = in.number(what), y = in.number(what), z = in.number(what);
  return {x, y, z};
}

// CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
void readCameras(const std::string& path, SparseModel& model, IdIndex& cameraIndex) {
  TextScanner in(path, TextScanner::Layout::Lines);
  while (in.toNextRecord()) {
    Camera camera;
    camera.id = in.integer<std::uint32_t>("the camera's id");
    check(in, cameraIndex.add(camera.id));
    const std::string_view name = in.word("the camera's model");
    camera.model = colmapModelFromName(name);
    if (camera.model == CameraModel::Unknown) in.fail("the camera model '" + printable(name) + "' is not known");
    camera.width = in.integer<std::uint64_t>("the camera's width");
    camera.height = in.integer<std::uint64_t>("the camera's height");
    for (std::size_t i = 0; i < parameterCount(camera.model); ++i)
      camera.parameters.push_back(in.number("a parameter of the camera"));
    check(in, findCameraFault(camera));
    in.endLine();
    model.cameras.push_back(std::move(camera));
  }
}

// POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
struct Tracks {
  std::vector<std::vector<TrackEntry>> entries;
  std::vector<std::size_t> lines;
};

Tracks readPoints(const std::string& path, SparseModel& model, IdIndex& pointIndex) {
  TextScanner in(path, TextScanner::Layout::Lines);
  Tracks tracks;
  while (in.toNextRecord()) {
    Point point;
    point.id = in.integer<std::uint64_t>("the point's id");
    check(in, pointIndex.add(point.id));
    point.position = readVector(in, "the point's position");
    for (std::uint8_t& channel : point.colour) channel = in.integer<std::uint8_t>("the point's colour");
    point.error = in.number("the point's error");
    tracks.lines.push_back(in.line());
    std::vector<TrackEntry>& track = tracks.entries.emplace_back();
    while (!in.lineEnds()) {
      const auto image = in.integer<std::uint32_t>("an image id of the track");
      track.push_back({image, in.integer<std::uint32_t>("an observation's index of the track")});
    }
    in.endLine();
    model.points.push_back(std::move(point));
  }
  return tracks;
}

// POINTS2D[] as (X, Y, POINT3D_ID)
void readObservations(TextScanner& in, const IdIndex& pointIndex, std::vector<Observation>& observations) {
  while (!in.lineEnds()) {
    Observation& observation = observations.emplace_back();
    observation.x = in.number("an observation's x");
    observation.y = in.number("an observation's y");
    const std::string_view point = in.word("an observation's point id");
    if (point == "-1") continue;
    const auto id = in.toInteger<std::uint64_t>("an observation's point id", point);
    if (!pointIndex.find(id, observation.point)) in.fail(pointIndex.unknown(id));
  }
  observations.shrink_to_fit();
  in.endLine();
}

// IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME; on the next line, which may be empty, the observations
void readImages(const std::string& path, const IdIndex& cameraIndex, const IdIndex& pointIndex, SparseModel& model,
                IdIndex& imageIndex) {
  TextScanner in(path, TextScanner::Layout::Lines);
  while (in.toNextRecord()) {
    Image image;
    image.id = in.integer<std::uint32_t>("the image's id");
    check(in, imageIndex.add(image.id));
    double q[4];
    for (double& coefficient : q) coefficient = in.number("the image's quaternion");
    check(in, setPoseFromQuaternion(q, readVector(in, "the image's translation"), image));
    const auto camera = in.integer<std::uint32_t>("the image's camera id");
    if (!cameraIndex.find(camera, image.camera)) in.fail(cameraIndex.unknown(camera));
    if (in.lineEnds()) in.fail("the line ends where the image's name is expected");
    image.name = in.restOfLine();
    if (in.atEndOfFile()) in.fail("the file ends where the image's observations are expected");
    readObservations(in, pointIndex, image.observations);
    model.images.push_back(std::move(image));
  }
}

}  // namespace

SparseModel readColmapText(const std::string& folder) {
  SparseModel model;
  IdIndex cameraIndex("camera"), imageIndex("image"), pointIndex("point");
  const std::string imagesPath = joinPath(folder, "images.txt"), pointsPath = joinPath(folder, "points3D.txt");
  readCameras(joinPath(folder, "cameras.txt"), model, cameraIndex);
  const Tracks tracks = readPoints(pointsPath, model, pointIndex);
  readImages(imagesPath, cameraIndex, pointIndex, model, imageIndex);
  const auto fail = [&](std::size_t point, const std::string& reason) {
    throw FileError::atLine(pointsPath, tracks.lines[point], reason);
  };
  const std::string fault = linkTracks(tracks.entries, imageIndex, fail, model);
  if (!fault.empty()) throw FileError::inFile(imagesPath, fault);
  return model;
}

}  // namespace sfm
}  // namespace hybridgv
