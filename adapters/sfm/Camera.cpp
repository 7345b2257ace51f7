#include "hybridgv/adapters/sfm/Camera.hpp"

#include <cmath>

#include "CameraModels.hpp"
#include "CheckArguments.hpp"
#include "hybridgv/detail/format.hpp"
#include "lens/Lens.hpp"

namespace hybridgv {
namespace sfm {
namespace {

Lens checkedLens(const Camera& camera) {
  const std::string fault = findCameraFault(camera);
  if (!fault.empty()) throwInvalid("camera", fault);
  return Lens(camera);
}

Lens checkedPlaneLens(const Camera& camera) {
  const Lens lens = checkedLens(camera);
  if (!hasImagePlane(camera.model)) throwInvalid("camera", std::string(toString(camera.model)) + " has no image plane");
  return lens;
}

void checkPixel(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y))
    throwInvalid("(x, y)", "must be finite, is (" + detail::format(x) + ", " + detail::format(y) + ")");
}

std::optional<Eigen::Vector3d> homogeneous(const std::optional<Eigen::Vector2d>& point, double scale) {
  if (!point) return std::nullopt;
  const Eigen::Vector3d result(scale * point->x(), scale * point->y(), 1);
  return result.allFinite() ? std::optional<Eigen::Vector3d>(result) : std::nullopt;
}

}  // namespace

bool hasImagePlane(CameraModel model) { return model != CameraModel::Equirectangular && model != CameraModel::Unknown; }

double focalLength(const Camera& camera) { return checkedLens(camera).focalLength(); }

std::optional<Eigen::Vector3d> bearingVector(const Camera& camera, double x, double y) {
  const Lens lens = checkedLens(camera);
  checkPixel(x, y);
  return lens.ray(x, y);
}

std::optional<Eigen::Vector3d> project(const Camera& camera, const Eigen::Vector3d& point) {
  const Lens lens = checkedLens(camera);
  checkFinite("point", point);
  return homogeneous(lens.project(point), 1);
}

std::optional<Eigen::Vector3d> undistort(const Camera& camera, double x, double y) {
  const Lens lens = checkedPlaneLens(camera);
  checkPixel(x, y);
  return homogeneous(lens.plane(x, y), lens.focalLength());
}

std::optional<Eigen::Vector3d> distort(const Camera& camera, const Eigen::Vector3d& imagePoint) {
  const Lens lens = checkedPlaneLens(camera);
  if (!imagePoint.allFinite() || imagePoint[2] == 0)
    throwInvalid("imagePoint", "must be finite, (u, v, 1), is " + detail::format(imagePoint));
  const double f = lens.focalLength();
  return homogeneous(lens.projectPlane({imagePoint[0] / imagePoint[2] / f, imagePoint[1] / imagePoint[2] / f}), 1);
}

}  // namespace sfm
}  // namespace hybridgv
