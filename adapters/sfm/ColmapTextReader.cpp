#include "ColmapBuilder.hpp"
#include "Consistency.hpp"
#include "FileContents.hpp"
#include "FolderReplacement.hpp"
#include "Printable.hpp"
#include "RigFiles.hpp"
#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "imageName.hpp"

namespace hybridgv {
namespace sfm {
namespace {

Eigen::Vector3d readVector(TextScanner& in, const char* what) {
  const double x = in.anyNumber(what), y = in.anyNumber(what), z = in.anyNumber(what);
  return {x, y, z};
}

// What an interrupted export leaves. (COLMAP's documentation tells users to make an empty points3D.txt, though.)
void refuseEmpty(const TextScanner& in) {
  if (in.isEmpty()) throw FileError::inFile(in.file(), "the file is empty");
}

// Reads record after record. A last line that is cut and cannot be read is left out.
template <class ReadRecord>
void readRecords(TextScanner& in, const ReadRecord& readRecord) {
  while (in.toNextRecord()) {
    try {
      readRecord();
    } catch (const FileError& error) {
      if (!in.isInCutLine()) throw;
      in.mending().note(Mend::CutLastLine, [&] { return error; });
      in.skipToEndOfFile();
    }
  }
}

// CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
void readCameras(const std::string& path, ColmapBuilder& builder) {
  TextScanner in(path, TextScanner::Layout::Lines, builder.mending());
  refuseEmpty(in);
  readRecords(in, [&] {
    Camera camera;
    camera.id = in.integer<std::uint32_t>("the camera's id");
    const std::string_view name = in.word("the camera's model");
    camera.model = colmapModelFromName(name);
    camera.width = in.integer<std::uint64_t>("the camera's width");
    camera.height = in.integer<std::uint64_t>("the camera's height");
    if (camera.model == CameraModel::Unknown) {
      camera.unknownModel = name;
      while (!in.lineEnds()) camera.parameters.push_back(in.anyNumber("a parameter of the camera"));
    } else {
      for (std::size_t i = 0; i < parameterCount(camera.model); ++i)
        camera.parameters.push_back(in.anyNumber("a parameter of the camera"));
    }
    builder.addCamera(in, std::move(camera), "'" + printable(name) + "'");
    in.endLine();
  });
}

// POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
void readPoints(const std::string& path, ColmapBuilder& builder) {
  TextScanner in(path, TextScanner::Layout::Lines, builder.mending());
  std::vector<TrackEntry> track;
  readRecords(in, [&] {
    Point point;
    point.id = in.integer<std::uint64_t>("the point's id");
    point.position = readVector(in, "the point's position");
    for (std::uint8_t& channel : point.colour) channel = in.colour("the point's colour");
    point.error = in.anyNumber("the point's error");
    track.clear();
    while (!in.lineEnds()) {
      const auto image = in.integer<std::uint32_t>("an image id of the track");
      track.push_back({image, in.integer<std::uint32_t>("an observation's index of the track")});
    }
    if (builder.beginPoint(in, point)) {
      for (const TrackEntry& entry : track) builder.addTrackEntry(entry);
      builder.endPoint(in.line());
    }
    in.endLine();
  });
}

// X, Y, POINT3D_ID
Observation readObservation(TextScanner& in, ColmapBuilder& builder) {
  const double x = in.anyNumber("an observation's x"), y = in.anyNumber("an observation's y");
  Observation result = builder.observation(in, x, y);
  const std::string_view point = in.word("an observation's point id");
  const bool isNone = point == "-1" || point == "-1.0";
  builder.setPoint(in, isNone ? ColmapBuilder::kNoPointId : in.toInteger<std::uint64_t>("an observation's point id", point),
                   result);
  return result;
}

// The line of an image's observations. A line that is cut keeps those before the cut.
void readObservations(TextScanner& in, ColmapBuilder& builder) {
  std::vector<Observation>& observations = builder.image().observations;
  try {
    while (!in.lineEnds()) observations.push_back(readObservation(in, builder));
  } catch (const FileError& error) {
    if (!in.isInCutLine()) throw;
    in.mending().note(Mend::CutLastLine, [&] { return error; });
    in.skipToEndOfFile();
  }
  in.endLine();
}

// IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME; on the next line, which may be empty, the observations
void readImages(const std::string& path, ColmapBuilder& builder) {
  TextScanner in(path, TextScanner::Layout::Lines, builder.mending());
  refuseEmpty(in);
  readRecords(in, [&] {
    const auto id = in.integer<std::uint32_t>("the image's id");
    double q[4];
    for (double& coefficient : q) coefficient = in.anyNumber("the image's quaternion");
    const Eigen::Vector3d translation = readVector(in, "the image's translation");
    const auto camera = in.integer<std::uint32_t>("the image's camera id");
    if (in.lineEnds()) in.fail("the line ends where the image's name is expected");
    builder.beginImage(in, id, q, translation, camera);
    builder.image().name = usableName(in, in.mending(), std::string(in.restOfLine()), id);
    if (in.atEndOfFile())
      in.mending().note(Mend::CutLastLine, [&] { return in.error("the file ends where the image's observations are expected"); });
    readObservations(in, builder);
    builder.endImage();
  });
}

}  // namespace

SparseModel readColmapText(const std::string& folder, const ReadOptions& options, ReadReport* report) {
  checkIsComplete(folder);
  Mending mending(options, report);
  ColmapBuilder builder(mending);
  const std::string imagesPath = joinPath(folder, "images.txt"), pointsPath = joinPath(folder, "points3D.txt");
  readCameras(joinPath(folder, "cameras.txt"), builder);
  readPoints(pointsPath, builder);
  readImages(imagesPath, builder);
  const auto errorAt = [&](std::size_t point, const std::string& reason) {
    return FileError::atLine(pointsPath, builder.tracks().places[point], reason);
  };
  const auto imagesError = [&](const std::string& reason) { return FileError::inFile(imagesPath, reason); };
  linkTracks(builder.tracks(), builder.imageIndex(), errorAt, imagesError, mending, builder.model());
  readRigsText(folder, mending, builder.model());
  checkConsistency(folder, mending, builder.model());
  return std::move(builder.model());
}

}  // namespace sfm
}  // namespace hybridgv
