#include "QueryCamera.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "CameraModels.hpp"
#include "CheckArguments.hpp"

namespace hybridgv {
namespace sfm {
namespace {

bool canBeEstimated(CameraModel model) {
  switch (model) {
    case CameraModel::SimplePinhole:
    case CameraModel::Pinhole:
    case CameraModel::SimpleRadial:
    case CameraModel::Radial:
    case CameraModel::OpenCV:
      return true;
    default:
      return false;
  }
}

}  // namespace

QueryCamera::QueryCamera(const Camera& camera, CameraKnowledge knowledge)
    : camera_(camera), isKnown_(knowledge == CameraKnowledge::Known) {
  if (isKnown_) {
    const std::string fault = findCameraFault(camera);
    if (!fault.empty()) throwInvalid("query.camera", fault);
    if (!hasImagePlane(camera.model))
      throwInvalid("query.camera", std::string("has the camera model ") + toString(camera.model) + " without an image plane");
    return;
  }
  if (!canBeEstimated(camera.model))
    throwInvalid("query.camera", std::string("the camera model ") + toString(camera.model) +
                                     " cannot be estimated (SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL and OPENCV can)");
  if (camera.parameters.empty() && (camera.width == 0 || camera.height == 0))
    throwInvalid("query.camera", "has neither a size nor a principal point");
  if (camera.parameters.empty()) {
    cx_ = static_cast<double>(camera.width) / 2;
    cy_ = static_cast<double>(camera.height) / 2;
    return;
  }
  const std::string fault = findCameraFault(camera);
  if (!fault.empty()) throwInvalid("query.camera", fault);
  const std::size_t first = focalLengthCount(camera.model);
  cx_ = camera.parameters[first];
  cy_ = camera.parameters[first + 1];
  aspect_ = camera.parameters[0] / camera.parameters[first - 1];
}

double firstDistortion(const Camera& camera) {
  const std::size_t first = focalLengthCount(camera.model) + 2;
  if (!mapsAPlane(camera.model) || first >= camera.parameters.size()) return 0;
  return camera.model == CameraModel::NvmRadial ? -camera.parameters[first] : camera.parameters[first];
}

void forgetCalibration(Camera& camera) {
  const bool hasSize = camera.width > 0 && camera.height > 0;
  const std::size_t focalLengths = focalLengthCount(camera.model);
  const double aspect = camera.parameters[0] / camera.parameters[focalLengths - 1];
  const double f = hasSize ? static_cast<double>(std::max(camera.width, camera.height)) : 1;
  const double cx = hasSize ? static_cast<double>(camera.width) / 2 : camera.parameters[focalLengths];
  const double cy = hasSize ? static_cast<double>(camera.height) / 2 : camera.parameters[focalLengths + 1];
  camera.model = CameraModel::Pinhole;
  camera.parameters = {f, f / aspect, cx, cy};
}

bool hasDistortion(CameraModel model) { return model != CameraModel::SimplePinhole && model != CameraModel::Pinhole; }

Camera estimatedCamera(const Camera& camera, double focalLength, double k1) {
  const QueryCamera given(camera, CameraKnowledge::Unknown);
  Camera result = camera;
  const std::size_t focalLengths = focalLengthCount(camera.model);
  result.parameters.assign(parameterCount(camera.model), 0);
  result.parameters[0] = focalLength;
  result.parameters[focalLengths - 1] = focalLength / given.aspect();
  result.parameters[focalLengths] = given.cx();
  result.parameters[focalLengths + 1] = given.cy();
  if (hasDistortion(camera.model)) result.parameters[focalLengths + 2] = k1;
  return result;
}

Camera distortedCamera(const Camera& camera, double focalLength, double k1) {
  const QueryCamera given(camera, CameraKnowledge::Unknown);
  Camera result = camera;
  result.model = CameraModel::OpenCV;
  result.parameters = {focalLength, focalLength / given.aspect(), given.cx(), given.cy(), k1, 0, 0, 0};
  return result;
}

std::optional<Eigen::Vector3d> QueryCamera::imagePoint(double x, double y) const {
  constexpr double kSmallestCosine = 0.5;
  if (!isKnown_) return Eigen::Vector3d(x - cx_, aspect_ * (y - cy_), 1);
  if (mapsAPlane(camera_.model)) return undistort(camera_, x, y);
  const std::optional<Eigen::Vector3d> ray = bearingVector(camera_, x, y);
  return ray && ray->z() >= kSmallestCosine ? undistort(camera_, x, y) : std::nullopt;
}

}  // namespace sfm
}  // namespace hybridgv
