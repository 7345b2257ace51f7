#include "MapViews.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "CameraModels.hpp"
#include "CheckArguments.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// What the images other than the one withheld see of a point: one view per image, in the order of the track.
std::vector<View> viewsOf(const SparseModel& model, std::size_t pointIndex, std::size_t withheld) {
  std::vector<View> views;
  std::unordered_set<std::size_t> done{withheld};
  for (const TrackElement& e : model.points[pointIndex].track) {
    if (e.image >= model.images.size() || e.observation >= model.images[e.image].observations.size())
      throwInvalid(modelElement("points", pointIndex), "the track names an observation that does not exist");
    const Image& image = model.images[e.image];
    if (!done.insert(e.image).second || !image.registered) continue;
    checkPose(model, e.image);
    if (const std::optional<MapRay> ray = mapRay(model, e.image, image.observations[e.observation])) views.push_back(ray->view);
  }
  return views;
}

double largestErrorAt(const std::vector<View>& views, const Eigen::Vector3d& point) {
  double largest = 0;
  for (const View& view : views) {
    const Eigen::Vector3d p = view.rotation.transpose() * (point - view.position);
    if (!(p[2] > 0)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::hypot(view.focalLength * p[0] / p[2] - view.u, view.focalLength * p[1] / p[2] - view.v));
  }
  return largest;
}

}  // namespace

std::string modelElement(const char* list, std::size_t index) {
  return std::string("model.") + list + "[" + std::to_string(index) + "]";
}

const Camera& cameraOf(const SparseModel& model, std::size_t image) {
  const std::size_t camera = model.images[image].camera;
  if (camera >= model.cameras.size()) throwInvalid(modelElement("images", image), "there is no camera " + std::to_string(camera));
  return model.cameras[camera];
}

void checkPose(const SparseModel& model, std::size_t image) {
  if (!model.images[image].rotation.allFinite() || !model.images[image].position.allFinite())
    throwInvalid(modelElement("images", image), "the pose must be finite, its position is " +
                                                    detail::format(model.images[image].position) + ", its rotation " +
                                                    detail::format(model.images[image].rotation));
}

void checkObservation(std::size_t image, const Observation& o) {
  if (!std::isfinite(o.x) || !std::isfinite(o.y))
    throwInvalid(modelElement("images", image),
                 "an observation must be finite, is (" + detail::format(o.x) + ", " + detail::format(o.y) + ")");
}

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

std::optional<Eigen::Vector3d> certainPosition(const SparseModel& model, std::size_t point, std::size_t withheld,
                                               const PointLimits& limits) {
  const std::vector<View> views = viewsOf(model, point, withheld);
  if (!haveParallax(views, limits.minParallax)) return std::nullopt;
  const Eigen::Vector3d& stored = model.points[point].position;
  if (withheld == kNoImage) {
    const bool isCertain = stored.allFinite() && largestErrorAt(views, stored) <= limits.maxErrorPx;
    return isCertain ? std::optional<Eigen::Vector3d>(stored) : std::nullopt;
  }
  const Triangulation result = triangulate(views);
  const bool isCertain = result.isInFront && result.largestError <= limits.maxErrorPx;
  return isCertain ? std::optional<Eigen::Vector3d>(result.point) : std::nullopt;
}

}  // namespace sfm
}  // namespace hybridgv
