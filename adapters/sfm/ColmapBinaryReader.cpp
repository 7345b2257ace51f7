#include "ByteScanner.hpp"
#include "ColmapBuilder.hpp"
#include "Consistency.hpp"
#include "FileContents.hpp"
#include "FolderReplacement.hpp"
#include "RigFiles.hpp"
#include "UnknownModelSizes.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "imageName.hpp"

namespace hybridgv {
namespace sfm {
namespace {

Eigen::Vector3d readVector(ByteScanner& in, const char* what) {
  const double x = in.anyNumber(what), y = in.anyNumber(what), z = in.anyNumber(what);
  return {x, y, z};
}

// The sizes in bytes of the shortest records: what a declared count is checked against.
constexpr std::size_t kCameraBytes = 4 + 4 + 8 + 8;
constexpr std::size_t kImageBytes = 4 + 7 * 8 + 4 + 1 + 8;
constexpr std::size_t kObservationBytes = std::size_t{3} * 8;
constexpr std::size_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;
constexpr std::size_t kTrackElementBytes = std::size_t{2} * 4;

void readCameras(const std::string& path, ColmapBuilder& builder) {
  ByteScanner in(path, builder.mending());
  std::map<std::int32_t, std::size_t> unknownSizes;
  const std::size_t count = in.count("the number of cameras", kCameraBytes);
  for (std::size_t i = 0; i < count; ++i) {
    Camera camera;
    camera.id = in.u32("the camera's id");
    const auto number = static_cast<std::int32_t>(in.u32("the camera's model"));
    const std::string modelName = "number " + std::to_string(number);
    camera.model = colmapModelFromNumber(number);
    std::size_t parameters = parameterCount(camera.model);
    if (camera.model == CameraModel::Unknown) {
      const FileError unknown = in.error("the camera model " + modelName + " is not known");
      if (builder.mending().options().strict) throw unknown;
      if (unknownSizes.empty() && !findUnknownModelSizes(in.contents(), unknownSizes)) throw unknown;
      parameters = unknownSizes.at(number);
      camera.unknownModel = std::to_string(number);
    }
    camera.width = in.u64("the camera's width");
    camera.height = in.u64("the camera's height");
    for (std::size_t k = 0; k < parameters; ++k) camera.parameters.push_back(in.anyNumber("a parameter of the camera"));
    builder.addCamera(in, std::move(camera), modelName);
  }
  in.expectEnd();
}

void readPoints(const std::string& path, ColmapBuilder& builder) {
  ByteScanner in(path, builder.mending());
  const std::size_t count = in.count("the number of points", kPointBytes);
  builder.reservePoints(count);
  for (std::size_t i = 0; i < count; ++i) {
    Point point;
    point.id = in.u64("the point's id");
    point.position = readVector(in, "the point's position");
    for (std::uint8_t& channel : point.colour) channel = in.byte("the point's colour");
    point.error = in.anyNumber("the point's error");
    const bool isKept = builder.beginPoint(in, point);
    const std::size_t place = in.offset();
    for (std::size_t left = in.count("the track's length", kTrackElementBytes); left > 0; --left) {
      const std::uint32_t image = in.u32("an image id of the track");
      const std::uint32_t observation = in.u32("an observation's index of the track");
      if (isKept) builder.addTrackEntry({image, observation});
    }
    if (isKept) builder.endPoint(place);
  }
  in.expectEnd();
}

void readObservations(ByteScanner& in, ColmapBuilder& builder) {
  const std::size_t count = in.count("the number of observations", kObservationBytes);
  std::vector<Observation>& observations = builder.image().observations;
  observations.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = in.anyNumber("an observation's x"), y = in.anyNumber("an observation's y");
    Observation observation = builder.observation(in, x, y);
    builder.setPoint(in, in.u64("an observation's point id"), observation);
    observations.push_back(observation);
  }
}

void readImages(const std::string& path, ColmapBuilder& builder) {
  ByteScanner in(path, builder.mending());
  const std::size_t count = in.count("the number of images", kImageBytes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = in.u32("the image's id");
    double q[4];
    for (double& coefficient : q) coefficient = in.anyNumber("the image's quaternion");
    const Eigen::Vector3d translation = readVector(in, "the image's translation");
    builder.beginImage(in, id, q, translation, in.u32("the image's camera id"));
    builder.image().name = usableName(in, builder.mending(), in.text("the image's name"), id);
    readObservations(in, builder);
    builder.endImage();
  }
  in.expectEnd();
}

}  // namespace

SparseModel readColmapBinary(const std::string& folder, const ReadOptions& options, ReadReport* report) {
  checkIsComplete(folder);
  Mending mending(options, report);
  ColmapBuilder builder(mending);
  const std::string imagesPath = joinPath(folder, "images.bin"), pointsPath = joinPath(folder, "points3D.bin");
  readCameras(joinPath(folder, "cameras.bin"), builder);
  readPoints(pointsPath, builder);
  readImages(imagesPath, builder);
  const auto errorAt = [&](std::size_t point, const std::string& reason) {
    return FileError::atByte(pointsPath, builder.tracks().places[point], reason);
  };
  const auto imagesError = [&](const std::string& reason) { return FileError::inFile(imagesPath, reason); };
  linkTracks(builder.tracks(), builder.imageIndex(), errorAt, imagesError, mending, builder.model());
  readRigsBinary(folder, mending, builder.model());
  checkConsistency(folder, mending, builder.model());
  return std::move(builder.model());
}

}  // namespace sfm
}  // namespace hybridgv
