// Writes databases as COLMAP does.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "SfmQuery.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"

namespace hybridgv {
namespace test {

class DatabaseFile {
 public:
  explicit DatabaseFile(const std::string& path) {
    if (sqlite3_open(path.c_str(), &handle_) != SQLITE_OK) throw std::runtime_error("cannot make " + path);
    run("PRAGMA synchronous = OFF");
  }
  ~DatabaseFile() { sqlite3_close(handle_); }
  DatabaseFile(const DatabaseFile&) = delete;
  DatabaseFile& operator=(const DatabaseFile&) = delete;

  void run(const std::string& sql) {
    if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sql + ": " + sqlite3_errmsg(handle_));
  }

  // Runs a statement with parameters ?1, ?2 .. for blobs.
  void run(const std::string& sql, const std::vector<std::string>& blobs) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(handle_, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
      throw std::runtime_error(sql + ": " + sqlite3_errmsg(handle_));
    for (std::size_t i = 0; i < blobs.size(); ++i)
      sqlite3_bind_blob(statement, static_cast<int>(i) + 1, blobs[i].data(), static_cast<int>(blobs[i].size()), SQLITE_TRANSIENT);
    const int result = sqlite3_step(statement);
    sqlite3_finalize(statement);
    if (result != SQLITE_DONE) throw std::runtime_error(sql + ": " + sqlite3_errmsg(handle_));
  }

  // The tables of COLMAP 3.8, as far as they are read.
  void createTables() {
    run("CREATE TABLE cameras (camera_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, model INTEGER NOT NULL, width INTEGER NOT "
        "NULL,"
        " height INTEGER NOT NULL, params BLOB, prior_focal_length INTEGER NOT NULL)");
    run("CREATE TABLE images (image_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, name TEXT NOT NULL UNIQUE, camera_id INTEGER "
        "NOT"
        " NULL, prior_qw REAL, prior_qx REAL, prior_qy REAL, prior_qz REAL, prior_tx REAL, prior_ty REAL, prior_tz REAL)");
    run("CREATE TABLE keypoints (image_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL, data "
        "BLOB)");
    run("CREATE TABLE descriptors (image_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL, data "
        "BLOB)");
    run("CREATE TABLE matches (pair_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL, data BLOB)");
    run("CREATE TABLE two_view_geometries (pair_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL, "
        "data"
        " BLOB, config INTEGER NOT NULL, F BLOB, E BLOB, H BLOB, qvec BLOB, tvec BLOB)");
  }
  // Those that COLMAP 3.12 has added.
  void createRigTables() {
    run("CREATE TABLE rigs (rig_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, ref_sensor_id INTEGER NOT NULL, ref_sensor_type"
        " INTEGER NOT NULL)");
    run("CREATE TABLE rig_sensors (rig_id INTEGER NOT NULL, sensor_id INTEGER NOT NULL, sensor_type INTEGER NOT NULL,"
        " sensor_from_rig BLOB)");
    run("CREATE TABLE frames (frame_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, rig_id INTEGER NOT NULL)");
    run("CREATE TABLE frame_data (frame_id INTEGER NOT NULL, data_id INTEGER NOT NULL, sensor_id INTEGER NOT NULL, sensor_type"
        " INTEGER NOT NULL)");
  }

  void addCamera(const sfm::Camera& camera, bool hasPrior) {
    run("INSERT INTO cameras VALUES (" +
            list({camera.id, static_cast<std::uint64_t>(camera.model), camera.width, camera.height}) + ", ?1, " +
            std::to_string(hasPrior) + ")",
        {bytesOf(camera.parameters)});
  }
  void addImage(std::uint32_t id, const std::string& name, std::uint32_t camera) {
    run("INSERT INTO images (image_id, name, camera_id) VALUES (" + std::to_string(id) + ", CAST(?1 AS TEXT), " +
            std::to_string(camera) + ")",
        {name});
  }
  // `columns` of float32, of which all but the first two are zero.
  void addKeypoints(std::uint32_t imageId, const std::vector<sfm::Keypoint>& keypoints, std::size_t columns = 6) {
    std::vector<float> cells(columns * keypoints.size());
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      cells[columns * i] = static_cast<float>(keypoints[i].x);
      cells[columns * i + 1] = static_cast<float>(keypoints[i].y);
    }
    run("INSERT INTO keypoints VALUES (" + list({imageId, keypoints.size(), columns}) + ", ?1)", {bytesOf(cells)});
  }
  // Into both tables of matches; pairs of keypoints of the first and of the second image.
  void addMatches(std::uint32_t first, std::uint32_t second, std::vector<std::array<std::uint32_t, 2>> pairs, int config = 3) {
    if (first > second) {
      std::swap(first, second);
      for (auto& pair : pairs) std::swap(pair[0], pair[1]);
    }
    const std::uint64_t id = std::uint64_t{2147483647} * first + second;
    const std::string row = list({id, pairs.size(), 2}) + ", ?1";
    run("INSERT INTO matches VALUES (" + row + ")", {bytesOf(pairs)});
    run("INSERT INTO two_view_geometries (pair_id, rows, cols, data, config) VALUES (" + row + ", " + std::to_string(config) +
            ")",
        {bytesOf(pairs)});
  }

  // The map and the query of a scene.
  void addScene(const QueryScene& scene) {
    run("BEGIN");
    for (const sfm::Camera& camera : scene.map.cameras) addCamera(camera, false);
    for (const sfm::Image& image : scene.map.images) {
      addImage(image.id, image.name, scene.map.cameras[image.camera].id);
      if (image.id == scene.query.id) continue;
      std::vector<sfm::Keypoint> keypoints;
      for (const sfm::Observation& o : image.observations) keypoints.push_back({o.x, o.y});
      addKeypoints(image.id, keypoints);
    }
    addKeypoints(scene.query.id, scene.query.keypoints);
    for (const sfm::ImageMatches& matches : scene.query.matches)
      addMatches(scene.query.id, scene.map.images[matches.image].id, matches.pairs);
    run("COMMIT");
  }

  template <class Values>
  static std::string bytesOf(const Values& values) {
    std::string bytes(values.size() * sizeof values[0], '\0');
    if (!bytes.empty()) std::memcpy(&bytes[0], values.data(), bytes.size());
    return bytes;
  }

 private:
  static std::string list(const std::vector<std::uint64_t>& numbers) {
    std::string text;
    for (const std::uint64_t number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
    return text;
  }

  sqlite3* handle_ = nullptr;
};

}  // namespace test
}  // namespace hybridgv
