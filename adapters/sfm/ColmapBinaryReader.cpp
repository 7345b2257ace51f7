#include "ByteScanner.hpp"
#include "CameraModels.hpp"
#include "FileContents.hpp"
#include "ModelLinks.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

void check(const ByteScanner& in, const std::string& fault) {
  if (!fault.empty()) in.fail(fault);
}

Eigen::Vector3d readVector(ByteScanner& in, const char* what) {
  const double x = in.number(what), y = in.number(what), z = in.number(what);
  return {x, y, z};
}

// The sizes in bytes of the shortest records: what a declared count is checked against.
constexpr std::size_t kCameraBytes = 4 + 4 + 8 + 8 + 3 * 8;
constexpr std::size_t kImageBytes = 4 + 7 * 8 + 4 + 1 + 8;
constexpr std::size_t kObservationBytes = std::size_t{3} * 8;
constexpr std::size_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;
constexpr std::size_t kTrackElementBytes = std::size_t{2} * 4;

void readCameras(const std::string& path, SparseModel& model, IdIndex& cameraIndex) {
  ByteScanner in(path);
  const std::size_t count = in.count("the number of cameras", kCameraBytes);
  for (std::size_t i = 0; i < count; ++i) {
    Camera camera;
    camera.id = in.u32("the camera's id");
    check(in, cameraIndex.add(camera.id));
    const auto number = static_cast<std::int32_t>(in.u32("the camera's model"));
    camera.model = colmapModelFromNumber(number);
    if (camera.model == CameraModel::Unknown) in.fail("the camera model number " + std::to_string(number) + " is not known");
    camera.width = in.u64("the camera's width");
    camera.height = in.u64("the camera's height");
    for (std::size_t k = 0; k < parameterCount(camera.model); ++k)
      camera.parameters.push_back(in.number("a parameter of the camera"));
    check(in, findCameraFault(camera));
    model.cameras.push_back(std::move(camera));
  }
  in.expectEnd();
}

struct Tracks {
  std::vector<std::vector<TrackEntry>> entries;
  std::vector<std::size_t> offsets;
};

Tracks readPoints(const std::string& path, SparseModel& model, IdIndex& pointIndex) {
  ByteScanner in(path);
  Tracks tracks;
  const std::size_t count = in.count("the number of points", kPointBytes);
  for (std::size_t i = 0; i < count; ++i) {
    Point point;
    point.id = in.u64("the point's id");
    check(in, pointIndex.add(point.id));
    point.position = readVector(in, "the point's position");
    for (std::uint8_t& channel : point.colour) channel = in.byte("the point's colour");
    point.error = in.number("the point's error");
    tracks.offsets.push_back(in.offset());
    std::vector<TrackEntry>& track = tracks.entries.emplace_back(in.count("the track's length", kTrackElementBytes));
    for (TrackEntry& entry : track) {
      entry.imageId = in.u32("an image id of the track");
      entry.observation = in.u32("an observation's index of the track");
    }
    model.points.push_back(std::move(point));
  }
  in.expectEnd();
  return tracks;
}

void readObservations(ByteScanner& in, const IdIndex& pointIndex, std::vector<Observation>& observations) {
  constexpr std::uint64_t kNoPointId = ~std::uint64_t{0};
  observations.resize(in.count("the number of observations", kObservationBytes));
  for (Observation& observation : observations) {
    observation.x = in.number("an observation's x");
    observation.y = in.number("an observation's y");
    const std::uint64_t id = in.u64("an observation's point id");
    if (id != kNoPointId && !pointIndex.find(id, observation.point)) in.fail(pointIndex.unknown(id));
  }
}

void readImages(const std::string& path, const IdIndex& cameraIndex, const IdIndex& pointIndex, SparseModel& model,
                IdIndex& imageIndex) {
  ByteScanner in(path);
  const std::size_t count = in.count("the number of images", kImageBytes);
  for (std::size_t i = 0; i < count; ++i) {
    Image image;
    image.id = in.u32("the image's id");
    check(in, imageIndex.add(image.id));
    double q[4];
    for (double& coefficient : q) coefficient = in.number("the image's quaternion");
    check(in, setPoseFromQuaternion(q, readVector(in, "the image's translation"), image));
    const std::uint32_t camera = in.u32("the image's camera id");
    if (!cameraIndex.find(camera, image.camera)) in.fail(cameraIndex.unknown(camera));
    image.name = in.text("the image's name");
    readObservations(in, pointIndex, image.observations);
    model.images.push_back(std::move(image));
  }
  in.expectEnd();
}

}  // namespace

SparseModel readColmapBinary(const std::string& folder) {
  SparseModel model;
  IdIndex cameraIndex("camera"), imageIndex("image"), pointIndex("point");
  const std::string imagesPath = joinPath(folder, "images.bin"), pointsPath = joinPath(folder, "points3D.bin");
  readCameras(joinPath(folder, "cameras.bin"), model, cameraIndex);
  const Tracks tracks = readPoints(pointsPath, model, pointIndex);
  readImages(imagesPath, cameraIndex, pointIndex, model, imageIndex);
  const auto fail = [&](std::size_t point, const std::string& reason) {
    throw FileError::atByte(pointsPath, tracks.offsets[point], reason);
  };
  const std::string fault = linkTracks(tracks.entries, imageIndex, fail, model);
  if (!fault.empty()) throw FileError::inFile(imagesPath, fault);
  return model;
}

}  // namespace sfm
}  // namespace hybridgv
