#include "hybridgv/adapters/sfm/addToModel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "CheckArguments.hpp"
#include "ColmapPose.hpp"
#include "FreeId.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"

namespace hybridgv {
namespace sfm {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

void checkSuccess(const QueryImage& query, const QueryLocalization& localization) {
  if (!localization.success) throwInvalid("localization", query.name + " was not localized");
  const LocalizationProblem& problem = localization.problem;
  const auto isKeypoint = [&](std::size_t k) { return k < query.keypoints.size(); };
  const bool isSame = problem.imageName == query.name && problem.keypoints2d3d.size() == localization.result.inliers2d3d.size() &&
                      problem.points2d3d.size() == problem.keypoints2d3d.size() &&
                      std::all_of(problem.keypoints2d3d.begin(), problem.keypoints2d3d.end(), isKeypoint);
  if (!isSame) throwInvalid("localization", "is not that of query " + query.name);
}

// The image of this name; kNone if there is none.
std::size_t findByName(const SparseModel& model, const std::string& name) {
  for (std::size_t i = 0; i < model.images.size(); ++i)
    if (model.images[i].name == name) return i;
  return kNone;
}

// Its features leave the tracks.
void forget(SparseModel& model, std::size_t image) {
  for (Point& point : model.points) {
    const auto isHere = [&](const TrackElement& e) { return e.image == image; };
    point.track.erase(std::remove_if(point.track.begin(), point.track.end(), isHere), point.track.end());
  }
}

bool isSame(const Camera& a, const Camera& b) {
  return a.model == b.model && a.width == b.width && a.height == b.height && a.parameters == b.parameters;
}

// The index of the camera in the model, to which it is added if need be.
std::size_t addCamera(SparseModel& model, const Camera& camera) {
  const auto hasId = [&](const Camera& other) { return other.id == camera.id; };
  const auto found = std::find_if(model.cameras.begin(), model.cameras.end(), hasId);
  if (found != model.cameras.end() && isSame(*found, camera)) return static_cast<std::size_t>(found - model.cameras.begin());
  model.cameras.push_back(camera);
  model.cameras.back().id = freeId(model.cameras.begin(), model.cameras.end() - 1, camera.id);
  return model.cameras.size() - 1;
}

double errorOf(const QueryLocalization& localization, std::size_t i) {
  const NoncentralHybridAdapter& adapter = localization.problem.adapter;
  return hybrid_pose::reprojectionError(localization.result.pose, localization.result.distortion, adapter.getImagePoint2d3d(i),
                                        adapter.getPoint(i));
}

// The 2D-3D inliers that become observations, best first; each keypoint and each point once.
std::vector<std::size_t> chooseInliers(const SparseModel& model, const QueryLocalization& localization) {
  std::vector<std::pair<double, std::size_t>> inliers;
  for (std::size_t i = 0; i < localization.result.inliers2d3d.size(); ++i) {
    if (localization.result.inliers2d3d[i] == 0) continue;
    if (localization.problem.points2d3d[i] >= model.points.size())
      throwInvalid("localization",
                   "is not that of this map: there is no point " + std::to_string(localization.problem.points2d3d[i]));
    inliers.emplace_back(errorOf(localization, i), i);
  }
  std::sort(inliers.begin(), inliers.end());
  std::set<std::size_t> keypoints, points;
  std::vector<std::size_t> chosen;
  for (const auto& [error, i] : inliers) {
    const std::size_t keypoint = localization.problem.keypoints2d3d[i], point = localization.problem.points2d3d[i];
    if (keypoints.count(keypoint) != 0 || points.count(point) != 0) continue;
    keypoints.insert(keypoint);
    points.insert(point);
    chosen.push_back(i);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

void addObservations(SparseModel& model, std::size_t image, const QueryImage& query, const QueryLocalization& localization) {
  const std::vector<std::size_t> inliers = chooseInliers(model, localization);
  std::vector<Observation>& observations = model.images[image].observations;
  observations.clear();
  for (const Keypoint& k : query.keypoints) {
    const bool isFinite = std::isfinite(k.x) && std::isfinite(k.y);
    observations.push_back({isFinite ? k.x : 0, isFinite ? k.y : 0, Observation::kNoPoint});
  }
  for (const std::size_t i : inliers) {
    const std::size_t keypoint = localization.problem.keypoints2d3d[i], point = localization.problem.points2d3d[i];
    observations[keypoint].point = point;
    model.points[point].track.push_back({image, keypoint});
  }
}

const RigSensor* findSensor(const SensorRig& rig, std::uint32_t camera) {
  for (const RigSensor& sensor : rig.sensors)
    if (sensor.sensor.type == 0 && sensor.sensor.id == camera) return &sensor;
  return nullptr;
}

// The rig of the database in the model, to which it is added if all its cameras are there; nullptr if it cannot be used.
const SensorRig* useRig(SparseModel& model, const SensorRig& rig) {
  for (const SensorRig& other : model.rigs) {
    if (other.id != rig.id) continue;
    const bool isSame = std::all_of(rig.sensors.begin(), rig.sensors.end(), [&](const RigSensor& s) {
      return s.sensor.type != 0 || findSensor(other, s.sensor.id) != nullptr;
    });
    return isSame ? &other : nullptr;
  }
  const auto isThere = [&](const RigSensor& s) {
    return s.sensor.type != 0 || std::any_of(model.cameras.begin(), model.cameras.end(),
                                             [&](const Camera& camera) { return camera.id == s.sensor.id; });
  };
  if (!std::all_of(rig.sensors.begin(), rig.sensors.end(), isThere)) return nullptr;
  model.rigs.push_back(rig);
  return &model.rigs.back();
}

// Puts the image into its frame of the database. The writers give one of its own to every image that is in none.
void addToFrame(SparseModel& model, const Image& image, const QueryImage& query) {
  if (model.rigs.empty() || !query.rig || !query.frame || image.id != query.id) return;
  const std::uint32_t camera = model.cameras[image.camera].id;
  const SensorRig* rig = useRig(model, *query.rig);
  const RigSensor* sensor = rig == nullptr ? nullptr : findSensor(*rig, camera);
  if (sensor == nullptr || (sensor->sensorFromRig.empty() && sensor != rig->sensors.data())) return;
  const FrameData datum{{0, camera}, image.id};
  for (Frame& frame : model.frames) {
    if (frame.id != query.frame->id) continue;
    if (frame.rigId == rig->id) frame.data.push_back(datum);
    return;
  }
  Frame frame;
  frame.id = query.frame->id;
  frame.rigId = rig->id;
  frame.rigFromWorld = sensor->sensorFromRig.empty() ? colmapPose(image) : poseOfRig(image, sensor->sensorFromRig);
  frame.data = {datum};
  model.frames.push_back(std::move(frame));
}

}  // namespace

std::size_t addToModel(SparseModel& model, const QueryImage& query, const QueryLocalization& localization) {
  checkSuccess(query, localization);
  std::size_t index = findByName(model, query.name);
  if (index != kNone && model.images[index].registered)
    throwInvalid("query", "the model has registered an image called " + query.name);
  if (index == kNone) {
    index = model.images.size();
    Image image;
    image.id = freeId(model.images.begin(), model.images.end(), query.id);
    image.name = query.name;
    model.images.push_back(std::move(image));
  } else {
    forget(model, index);
  }
  const std::size_t camera = addCamera(model, localization.camera);
  Image& image = model.images[index];
  image.camera = camera;
  image.registered = true;
  image.carried = false;
  image.rotation = localization.result.pose.rotation;
  image.position = localization.result.pose.position;
  image.storedPose = {};
  addObservations(model, index, query, localization);
  addToFrame(model, image, query);
  return index;
}

}  // namespace sfm
}  // namespace hybridgv
