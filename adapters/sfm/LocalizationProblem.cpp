#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "CameraModels.hpp"
#include "CheckArguments.hpp"
#include "Triangulation.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// One correspondence of the query, before the rig cameras are numbered.
struct RayMatch {
  Eigen::Vector3d imagePoint, bearing;
  std::size_t image, point;
};
struct PointMatch {
  Eigen::Vector3d imagePoint, position;
  std::size_t point;
};
struct Matches {
  std::vector<RayMatch> rays;
  std::vector<PointMatch> points;
};

std::string element(const char* list, std::size_t index) {
  return std::string("model.") + list + "[" + std::to_string(index) + "]";
}

const Camera& cameraOf(const SparseModel& model, std::size_t image) {
  const std::size_t camera = model.images[image].camera;
  if (camera >= model.cameras.size()) throwInvalid(element("images", image), "there is no camera " + std::to_string(camera));
  return model.cameras[camera];
}

void checkPose(const SparseModel& model, std::size_t image) {
  if (!model.images[image].rotation.allFinite() || !model.images[image].position.allFinite())
    throwInvalid(element("images", image), "the pose must be finite, its position is " +
                                               detail::format(model.images[image].position) + ", its rotation " +
                                               detail::format(model.images[image].rotation));
}

void checkObservation(std::size_t image, const Observation& o) {
  if (!std::isfinite(o.x) || !std::isfinite(o.y))
    throwInvalid(element("images", image),
                 "an observation must be finite, is (" + detail::format(o.x) + ", " + detail::format(o.y) + ")");
}

// The query's image point. A plane magnifies the pixels of a fisheye camera by 1/cos^2 of the angle to the axis, and their noise
// with them.
std::optional<Eigen::Vector3d> queryImagePoint(const SparseModel& model, std::size_t image, const Observation& o) {
  constexpr double kSmallestCosine = 0.5;
  checkObservation(image, o);
  const Camera& camera = cameraOf(model, image);
  if (mapsAPlane(camera.model)) return undistort(camera, o.x, o.y);
  const std::optional<Eigen::Vector3d> ray = bearingVector(camera, o.x, o.y);
  return ray && ray->z() >= kSmallestCosine ? undistort(camera, o.x, o.y) : std::nullopt;
}

// What a map image sees: its image point, or, if its camera is no distorted pinhole, the centre of the image of a pinhole camera
// that is turned towards the ray. Distances in that image are pixels of the map image on its axis.
struct MapRay {
  View view;
  Eigen::Vector3d bearing;  // in the map image's frame
};

std::optional<MapRay> mapRay(const SparseModel& model, std::size_t imageIndex, const Observation& o) {
  checkObservation(imageIndex, o);
  const Image& image = model.images[imageIndex];
  const Camera& camera = cameraOf(model, imageIndex);
  const double f = focalLength(camera);
  if (mapsAPlane(camera.model)) {
    const std::optional<Eigen::Vector3d> point = undistort(camera, o.x, o.y);
    if (!point) return std::nullopt;
    const View view{image.rotation, image.position, f, (*point)[0], (*point)[1]};
    return MapRay{view, view.direction()};
  }
  const std::optional<Eigen::Vector3d> ray = bearingVector(camera, o.x, o.y);
  if (!ray) return std::nullopt;
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), *ray).toRotationMatrix();
  return MapRay{{image.rotation * turn, image.position, f, 0, 0}, *ray};
}

void checkOptions(const LocalizationProblemOptions& options) {
  checkNotNegative("options.minParallaxDeg", options.minParallaxDeg);
  checkNotNegative("options.maxMapReprojectionErrorPx", options.maxMapReprojectionErrorPx);
}

// An image that sees a point twice counts with the observation that the track names first.
bool isFirstOfTrack(const Point& point, std::size_t image, std::size_t observation) {
  const auto sees = [&](const TrackElement& e) { return e.image == image; };
  const auto first = std::find_if(point.track.begin(), point.track.end(), sees);
  return first != point.track.end() && first->observation == observation;
}

// What the images other than the query see of the point: one view per image, in the order of the track.
struct MapViews {
  std::vector<View> views;
  std::vector<Eigen::Vector3d> bearings;
  std::vector<std::size_t> images;
};

MapViews viewsOf(const SparseModel& model, std::size_t pointIndex, std::size_t query) {
  MapViews result;
  std::unordered_set<std::size_t> done{query};
  for (const TrackElement& e : model.points[pointIndex].track) {
    if (e.image >= model.images.size() || e.observation >= model.images[e.image].observations.size())
      throwInvalid(element("points", pointIndex), "the track names an observation that does not exist");
    const Image& image = model.images[e.image];
    if (!done.insert(e.image).second || !image.registered) continue;
    checkPose(model, e.image);
    if (const std::optional<MapRay> ray = mapRay(model, e.image, image.observations[e.observation])) {
      result.views.push_back(ray->view);
      result.bearings.push_back(ray->bearing);
      result.images.push_back(e.image);
    }
  }
  return result;
}

Matches findMatches(const SparseModel& model, std::size_t query, const LocalizationProblemOptions& options) {
  const double minParallax = options.minParallaxDeg * std::acos(-1.0) / 180;
  Matches matches;
  const std::vector<Observation>& observations = model.images[query].observations;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    if (o.point == Observation::kNoPoint) continue;
    if (o.point >= model.points.size()) throwInvalid(element("images", query), "there is no point " + std::to_string(o.point));
    const std::optional<Eigen::Vector3d> imagePoint = queryImagePoint(model, query, o);
    if (!imagePoint || !isFirstOfTrack(model.points[o.point], query, i)) continue;
    const MapViews map = viewsOf(model, o.point, query);
    if (map.views.empty()) continue;
    if (haveParallax(map.views, minParallax)) {
      const Triangulation result = triangulate(map.views);
      if (result.isInFront && result.largestError <= options.maxMapReprojectionErrorPx) {
        matches.points.push_back({*imagePoint, result.point, o.point});
        continue;
      }
    }
    matches.rays.push_back({*imagePoint, map.bearings[0], map.images[0], o.point});
  }
  return matches;
}

LocalizationProblem toProblem(const SparseModel& model, const Matches& matches) {
  std::vector<std::size_t> rig;
  for (const RayMatch& match : matches.rays) rig.push_back(match.image);
  std::sort(rig.begin(), rig.end());
  rig.erase(std::unique(rig.begin(), rig.end()), rig.end());

  NoncentralHybridAdapter::Vectors centres, imagePoints2d2d, bearings, imagePoints2d3d, positions;
  NoncentralHybridAdapter::Matrices rotations;
  std::vector<int> camIndices;
  std::vector<double> focalLengths;
  std::vector<std::size_t> points2d2d, points2d3d;
  for (const std::size_t image : rig) {
    centres.push_back(model.images[image].position);
    rotations.push_back(model.images[image].rotation);
    focalLengths.push_back(focalLength(cameraOf(model, image)));
  }
  for (const RayMatch& match : matches.rays) {
    imagePoints2d2d.push_back(match.imagePoint);
    bearings.push_back(match.bearing);
    camIndices.push_back(static_cast<int>(std::lower_bound(rig.begin(), rig.end(), match.image) - rig.begin()));
    points2d2d.push_back(match.point);
  }
  for (const PointMatch& match : matches.points) {
    imagePoints2d3d.push_back(match.imagePoint);
    positions.push_back(match.position);
    points2d3d.push_back(match.point);
  }
  NoncentralHybridAdapter adapter(imagePoints2d2d, bearings, camIndices, centres, rotations, imagePoints2d3d, positions);
  adapter.setRigFocalLengths(focalLengths);
  const std::vector<bool> none2d2d(points2d2d.size()), none2d3d(points2d3d.size());
  return {"", adapter, std::nullopt, std::move(rig), std::move(points2d2d), std::move(points2d3d), none2d2d, none2d3d};
}

}  // namespace

LocalizationProblem makeLocalizationProblem(const SparseModel& model, std::size_t imageIndex,
                                            const LocalizationProblemOptions& options) {
  checkOptions(options);
  if (imageIndex >= model.images.size())
    throwInvalid("imageIndex", std::to_string(imageIndex) + " is outside the " + std::to_string(model.images.size()) + " images");
  const Image& query = model.images[imageIndex];
  if (!query.registered) throwInvalid("imageIndex", "image " + std::to_string(imageIndex) + " (" + query.name + ") has no pose");
  if (!hasImagePlane(cameraOf(model, imageIndex).model))
    throwInvalid("imageIndex", "image " + std::to_string(imageIndex) + " (" + query.name + ") has the camera model " +
                                   toString(cameraOf(model, imageIndex).model) + " without an image plane");
  checkPose(model, imageIndex);
  LocalizationProblem problem = toProblem(model, findMatches(model, imageIndex, options));
  problem.imageName = query.name;
  problem.reference = FocalPose{query.rotation, query.position, focalLength(cameraOf(model, imageIndex))};
  return problem;
}

}  // namespace sfm
}  // namespace hybridgv
