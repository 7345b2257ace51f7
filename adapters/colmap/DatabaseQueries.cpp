#include "hybridgv/adapters/colmap/DatabaseQueries.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

constexpr double kSamePlacePx = 0.01;  // models have the database's float32 numbers, or a few digits of them

// Empty, or how the image's features differ from the keypoints.
std::string findDifference(const std::vector<Observation>& observations, const std::vector<Keypoint>& keypoints) {
  if (observations.size() != keypoints.size())
    return "has " + std::to_string(keypoints.size()) + " keypoints in the database and " + std::to_string(observations.size()) +
           " in the map";
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const double distance = std::hypot(observations[i].x - keypoints[i].x, observations[i].y - keypoints[i].y);
    if (!(distance <= kSamePlacePx))
      return "has other keypoints in the database than in the map (number " + std::to_string(i) + ")";
  }
  return {};
}

bool isVerified(const DatabaseMatches& matches) { return !matches.config || *matches.config > kConfigDegenerate; }

}  // namespace

struct DatabaseQueries::Join {
  // An image of the map in the database.
  struct Partner {
    std::size_t image;  // index into SparseModel::images
    std::uint32_t id;   // in the database
    bool isChecked = false;
    std::string difference;  // why its matches cannot be used
  };
  ColmapDatabase database;
  const SparseModel& map;
  DatabaseQueryOptions options;
  std::vector<Partner> partners;
  std::map<std::uint32_t, std::size_t> cameras;  // camera_id of the database -> a camera of the map
  std::map<std::string, std::size_t> registered;

  Join(ColmapDatabase database_, const SparseModel& map_, const DatabaseQueryOptions& options_)
      : database(std::move(database_)), map(map_), options(options_) {
    database.matches(options.table, 0, 0);  // of no pair: fails here if the table is not there
    for (std::size_t i = 0; i < map.images.size(); ++i) {
      if (!map.images[i].registered || !registered.emplace(map.images[i].name, i).second) continue;
      const DatabaseImage* image = database.findImage(map.images[i].name);
      if (image == nullptr) continue;
      partners.push_back({i, image->id, false, {}});
      cameras.emplace(image->camera, map.images[i].camera);
    }
  }

  // The keypoints are compared when the image is first matched: that takes the time of reading them.
  const std::string& difference(Partner& partner) {
    if (partner.isChecked) return partner.difference;
    partner.isChecked = true;
    try {
      partner.difference = findDifference(map.images[partner.image].observations, database.keypoints(partner.id));
    } catch (const FileError& error) {
      partner.difference = std::string("is damaged in the database: ") + error.what();
    }
    return partner.difference;
  }

  void setCamera(const DatabaseImage& image, QueryImage& query) {
    const auto shared = cameras.find(image.camera);
    if (options.useCamerasOfMap && shared != cameras.end()) {
      query.camera = map.cameras[shared->second];
      query.knowledge = CameraKnowledge::Known;
      return;
    }
    const DatabaseCamera* camera = database.findCamera(image.camera);
    const std::string where = "table cameras, image " + image.name + ": ";
    if (camera == nullptr) throw FileError::inFile(database.path(), where + "there is no camera " + std::to_string(image.camera));
    if (camera->camera.model == CameraModel::Unknown) throw FileError::inFile(database.path(), where + "its model is not known");
    query.camera = camera->camera;
    query.knowledge = camera->hasPriorFocalLength ? CameraKnowledge::Prior : CameraKnowledge::Unknown;
    try {
      focalLength(query.camera);
    } catch (const std::invalid_argument& error) {
      throw FileError::inFile(database.path(), where + error.what());
    }
  }

  void addMatches(Partner& partner, QueryImage& query) {
    DatabaseMatches matches;
    const std::string name = "image " + map.images[partner.image].name;
    try {
      matches = database.matches(options.table, query.id, partner.id);
    } catch (const FileError& error) {
      ++query.leftOut.pairsDamaged;
      query.notes.emplace_back(error.what());
      return;
    }
    if (matches.pairs.empty()) return;
    if (!isVerified(matches))
      ++query.leftOut.unverifiedPairs;
    else if (options.ignoreWatermarks && matches.config == kConfigWatermark)
      ++query.leftOut.watermarkPairs;
    else if (matches.pairs.size() < options.minMatches)
      ++query.leftOut.pairsWithFewMatches;
    else if (difference(partner).empty())
      query.matches.push_back({partner.image, std::move(matches.pairs), {}});
    else {
      ++query.leftOut.imagesThatDiffer;
      query.notes.push_back(name + " " + difference(partner));
    }
  }
};

DatabaseQueries::DatabaseQueries(ColmapDatabase database, const SparseModel& map, const DatabaseQueryOptions& options)
    : join_(std::make_unique<Join>(std::move(database), map, options)) {}
DatabaseQueries::~DatabaseQueries() = default;
DatabaseQueries::DatabaseQueries(DatabaseQueries&&) noexcept = default;

const ColmapDatabase& DatabaseQueries::database() const { return join_->database; }

std::vector<std::string> DatabaseQueries::namesNotInMap() const {
  std::vector<std::string> names;
  for (const DatabaseImage& image : join_->database.images())
    if (join_->registered.count(image.name) == 0) names.push_back(image.name);
  return names;
}

QueryImage DatabaseQueries::read(const std::string& name) {
  const ColmapDatabase& database = join_->database;
  const DatabaseImage* image = database.findImage(name);
  if (image == nullptr) throw std::invalid_argument("name: " + database.path() + " has no image " + name);
  QueryImage query;
  query.id = image->id;
  query.name = name;
  join_->setCamera(*image, query);
  query.keypoints = database.keypoints(image->id);
  query.rig = database.rigOf(image->camera);
  query.frame = database.frameOf(image->id);
  for (Join::Partner& partner : join_->partners)
    if (partner.id != image->id) join_->addMatches(partner, query);
  return query;
}

}  // namespace sfm
}  // namespace hybridgv
