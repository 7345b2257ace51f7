#include "hybridgv/adapters/colmap/ColmapDatabase.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

#include "Blobs.hpp"
#include "Sqlite.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

constexpr std::int64_t kMaxImageId = 2147483647;  // pair_id = kMaxImageId * smaller id + larger id
constexpr std::int64_t kMaxId = std::numeric_limits<std::uint32_t>::max();
constexpr std::int64_t kAny = std::numeric_limits<std::int64_t>::max();

bool hasColumn(const std::vector<std::string>& columns, const char* name) {
  return std::find(columns.begin(), columns.end(), name) != columns.end();
}

// "SELECT a, b FROM t" after making sure that they are there.
std::string select(const SqliteFile& file, const std::string& table, const std::vector<const char*>& names) {
  const std::vector<std::string> columns = file.columns(table);
  if (columns.empty()) throw FileError::inFile(file.path(), "there is no table " + table + ": this is no database of COLMAP");
  std::string sql = "SELECT ";
  for (const char* name : names) {
    if (!hasColumn(columns, name)) throw FileError::inFile(file.path(), "table " + table + " has no column " + name);
    sql += std::string(name == names.front() ? "" : ", ") + name;
  }
  return sql + " FROM " + table;
}

// Numbers below NvmRadial are COLMAP's.
CameraModel modelOf(std::int64_t number) {
  const bool isKnown = number >= 0 && number <= static_cast<std::int64_t>(CameraModel::Equirectangular);
  return isKnown ? static_cast<CameraModel>(number) : CameraModel::Unknown;
}

std::int64_t pairId(std::uint32_t a, std::uint32_t b) {
  return kMaxImageId * static_cast<std::int64_t>(std::min(a, b)) + static_cast<std::int64_t>(std::max(a, b));
}

SensorId sensorAt(const SqliteStatement& row, int type, int id) {
  return {static_cast<std::int32_t>(row.integer(type, "sensor_type", 0, std::numeric_limits<std::int32_t>::max())),
          static_cast<std::uint32_t>(row.integer(id, "sensor_id", 0, kMaxId))};
}

}  // namespace

struct ColmapDatabase::Contents {
  SqliteFile file;
  std::vector<DatabaseImage> images;
  std::unordered_map<std::string, std::size_t> byName;
  std::map<std::uint32_t, DatabaseCamera> cameras;
  std::map<std::uint32_t, SensorRig> rigs;  // by rig_id
  std::map<std::uint32_t, std::uint32_t> rigOfCamera;
  // Prepared where they are first used.
  std::unique_ptr<SqliteStatement> keypointCount, keypoints, verified, raw, frames, frameData;
  bool hasConfig = false, hasFrames = false;

  explicit Contents(const std::string& path) : file(path) {
    readCameras();
    readImages();
    readRigs();
  }

  void readCameras() {
    SqliteStatement row(file, "table cameras",
                        select(file, "cameras", {"camera_id", "model", "width", "height", "params", "prior_focal_length"}));
    while (row.next()) {
      DatabaseCamera camera;
      camera.camera.id = static_cast<std::uint32_t>(row.integer(0, "camera_id", 0, kMaxId));
      camera.camera.model = modelOf(row.integer(1, "model", -1, kAny));
      camera.camera.width = static_cast<std::uint64_t>(row.integer(2, "width", 0, kAny));
      camera.camera.height = static_cast<std::uint64_t>(row.integer(3, "height", 0, kAny));
      const std::string fault = decodeNumbers(row.blob(4), camera.camera.parameters);
      if (!fault.empty()) row.fail("camera " + std::to_string(camera.camera.id) + ": " + fault);
      camera.hasPriorFocalLength = row.integer(5, "prior_focal_length", -kAny, kAny) != 0;
      cameras.emplace(camera.camera.id, std::move(camera));
    }
  }

  void readImages() {
    SqliteStatement row(file, "table images", select(file, "images", {"image_id", "name", "camera_id"}) + " ORDER BY image_id");
    while (row.next()) {
      DatabaseImage image;
      image.id = static_cast<std::uint32_t>(row.integer(0, "image_id", 0, kMaxImageId - 1));
      image.name = std::string(row.blob(1));
      image.camera = static_cast<std::uint32_t>(row.integer(2, "camera_id", 0, kMaxId));
      if (image.name.empty()) row.fail("image " + std::to_string(image.id) + " has no name");
      if (!images.empty() && images.back().id == image.id) row.fail("image " + std::to_string(image.id) + " occurs twice");
      if (!byName.emplace(image.name, images.size()).second) row.fail("two images are called " + image.name);
      images.push_back(std::move(image));
    }
  }

  // Tables of COLMAP 3.12 and later.
  void readRigs() {
    if (file.columns("rigs").empty() || file.columns("rig_sensors").empty()) return;
    SqliteStatement row(file, "table rigs", select(file, "rigs", {"rig_id", "ref_sensor_id", "ref_sensor_type"}));
    while (row.next()) {
      SensorRig rig;
      rig.id = static_cast<std::uint32_t>(row.integer(0, "rig_id", 0, kMaxId));
      rig.sensors.push_back({sensorAt(row, 2, 1), {}});
      rigs.emplace(rig.id, std::move(rig));
    }
    SqliteStatement sensor(file, "table rig_sensors",
                           select(file, "rig_sensors", {"rig_id", "sensor_id", "sensor_type", "sensor_from_rig"}));
    while (sensor.next()) addSensor(sensor);
    for (const auto& [id, rig] : rigs)
      for (const RigSensor& s : rig.sensors)
        if (s.sensor.type == 0) rigOfCamera.emplace(s.sensor.id, id);
    hasFrames = !file.columns("frames").empty() && !file.columns("frame_data").empty();
  }

  void addSensor(const SqliteStatement& row) {
    constexpr std::size_t kPoseNumbers = 7;
    const auto rig = rigs.find(static_cast<std::uint32_t>(row.integer(0, "rig_id", 0, kMaxId)));
    if (rig == rigs.end()) row.fail("there is no rig " + std::to_string(row.integer(0, "rig_id", 0, kMaxId)));
    RigSensor sensor{sensorAt(row, 2, 1), {}};
    if (!row.isNull(3)) {
      const std::string fault = decodeNumbers(row.blob(3), sensor.sensorFromRig);
      if (!fault.empty() || sensor.sensorFromRig.size() != kPoseNumbers) row.fail("sensor_from_rig is no pose");
    }
    rig->second.sensors.push_back(std::move(sensor));
  }

  SqliteStatement& statement(std::unique_ptr<SqliteStatement>& place, const std::string& table,
                             const std::vector<const char*>& columns, const char* key) {
    if (!place)
      place = std::make_unique<SqliteStatement>(file, "table " + table, select(file, table, columns) + " WHERE " + key + " = ?1");
    return *place;
  }

  SqliteStatement& matchesStatement(MatchTable table) {
    if (table == MatchTable::Raw) return statement(raw, "matches", {"rows", "cols", "data"}, "pair_id");
    if (verified) return *verified;
    const std::string name = file.columns("two_view_geometries").empty() && !file.columns("inlier_matches").empty()
                                 ? "inlier_matches"  // before COLMAP 3.2
                                 : "two_view_geometries";
    hasConfig = hasColumn(file.columns(name), "config");
    std::vector<const char*> columns{"rows", "cols", "data"};
    if (hasConfig) columns.push_back("config");
    return statement(verified, name, columns, "pair_id");
  }
};

ColmapDatabase::ColmapDatabase(const std::string& path) : contents_(std::make_unique<Contents>(path)) {}
ColmapDatabase::~ColmapDatabase() = default;
ColmapDatabase::ColmapDatabase(ColmapDatabase&&) noexcept = default;
ColmapDatabase& ColmapDatabase::operator=(ColmapDatabase&&) noexcept = default;

const std::string& ColmapDatabase::path() const { return contents_->file.path(); }

const std::vector<DatabaseImage>& ColmapDatabase::images() const { return contents_->images; }

const DatabaseImage* ColmapDatabase::findImage(const std::string& name) const {
  const auto found = contents_->byName.find(name);
  return found == contents_->byName.end() ? nullptr : &contents_->images[found->second];
}

const DatabaseCamera* ColmapDatabase::findCamera(std::uint32_t id) const {
  const auto found = contents_->cameras.find(id);
  return found == contents_->cameras.end() ? nullptr : &found->second;
}

std::size_t ColmapDatabase::keypointCount(std::uint32_t imageId) const {
  SqliteStatement& row = contents_->statement(contents_->keypointCount, "keypoints", {"rows"}, "image_id");
  const SqliteStatement::Run run = row.bind(imageId);
  if (!row.next()) return 0;
  return static_cast<std::size_t>(row.integer(0, "rows", 0, kAny));
}

std::vector<Keypoint> ColmapDatabase::keypoints(std::uint32_t imageId) const {
  SqliteStatement& row = contents_->statement(contents_->keypoints, "keypoints", {"rows", "cols", "data"}, "image_id");
  const SqliteStatement::Run run = row.bind(imageId);
  std::vector<Keypoint> result;
  if (!row.next()) return result;
  const BlobShape shape{row.integer(0, "rows", 0, kAny), row.integer(1, "cols", 0, kAny)};
  const std::string fault = decodeKeypoints(shape, row.blob(2), result);
  if (!fault.empty()) row.fail("image " + std::to_string(imageId) + ": " + fault);
  return result;
}

DatabaseMatches ColmapDatabase::matches(MatchTable table, std::uint32_t firstId, std::uint32_t secondId) const {
  SqliteStatement& row = contents_->matchesStatement(table);
  const SqliteStatement::Run run = row.bind(pairId(firstId, secondId));
  DatabaseMatches result;
  if (!row.next()) return result;
  const BlobShape shape{row.integer(0, "rows", 0, kAny), row.integer(1, "cols", 0, kAny)};
  const std::string fault = decodeMatches(shape, row.blob(2), firstId > secondId, result.pairs);
  if (!fault.empty())
    row.fail("images " + std::to_string(std::min(firstId, secondId)) + " and " + std::to_string(std::max(firstId, secondId)) +
             ": " + fault);
  if (table == MatchTable::Verified && contents_->hasConfig)
    result.config = static_cast<int>(row.integer(3, "config", 0, std::numeric_limits<int>::max()));
  return result;
}

std::optional<SensorRig> ColmapDatabase::rigOf(std::uint32_t cameraId) const {
  const auto rig = contents_->rigOfCamera.find(cameraId);
  return rig == contents_->rigOfCamera.end() ? std::nullopt : std::optional<SensorRig>(contents_->rigs.at(rig->second));
}

std::optional<Frame> ColmapDatabase::frameOf(std::uint32_t imageId) const {
  if (!contents_->hasFrames) return std::nullopt;
  SqliteStatement& place = contents_->statement(contents_->frames, "frame_data", {"frame_id", "sensor_type"}, "data_id");
  const SqliteStatement::Run placeRun = place.bind(imageId);
  Frame frame;
  bool isFound = false;
  while (!isFound && place.next()) {
    isFound = place.integer(1, "sensor_type", 0, kMaxId) == 0;
    frame.id = static_cast<std::uint32_t>(place.integer(0, "frame_id", 0, kMaxId));
  }
  if (!isFound) return std::nullopt;
  SqliteStatement rig(contents_->file, "table frames", select(contents_->file, "frames", {"rig_id"}) + " WHERE frame_id = ?1");
  const SqliteStatement::Run rigRun = rig.bind(frame.id);
  if (!rig.next()) rig.fail("there is no frame " + std::to_string(frame.id));
  frame.rigId = static_cast<std::uint32_t>(rig.integer(0, "rig_id", 0, kMaxId));
  SqliteStatement& data =
      contents_->statement(contents_->frameData, "frame_data", {"sensor_type", "sensor_id", "data_id"}, "frame_id");
  const SqliteStatement::Run dataRun = data.bind(frame.id);
  while (data.next())
    frame.data.push_back({sensorAt(data, 0, 1), static_cast<std::uint64_t>(data.integer(2, "data_id", 0, kAny))});
  return frame;
}

}  // namespace sfm
}  // namespace hybridgv
