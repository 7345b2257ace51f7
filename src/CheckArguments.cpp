#include "CheckArguments.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hybridgv {

void throwInvalid(const std::string& argument, const std::string& reason) {
  throw std::invalid_argument("hybridgv: " + argument + ": " + reason);
}

// Names are put together only where an error is reported: these functions run once per minimal sample.
static void checkAllDifferent(const char* name, const char* part, const std::vector<int>& indices, int needed) {
  const auto end = indices.begin() + needed;
  const auto refuse = [&](int index) {
    throwInvalid(std::string(name) + part, "index " + std::to_string(index) + " is repeated");
  };
  if (needed <= 8) {  // a minimal sample: no allocation
    for (auto i = indices.begin(); i != end; ++i)
      if (std::find(indices.begin(), i, *i) != i) refuse(*i);
    return;
  }
  std::vector<int> sorted(indices.begin(), end);
  std::sort(sorted.begin(), sorted.end());
  const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
  if (repeated != sorted.end()) refuse(*repeated);
}

void checkIndices(const char* name, const char* part, const std::vector<int>& indices, int needed, std::size_t available) {
  if (indices.size() < static_cast<std::size_t>(needed))
    throwInvalid(std::string(name) + part, "needs " + std::to_string(needed) + " indices, got " + std::to_string(indices.size()));
  for (int i = 0; i < needed; ++i) {
    const int index = indices[static_cast<std::size_t>(i)];
    if (index < 0 || static_cast<std::size_t>(index) >= available)
      throwInvalid(std::string(name) + part, "index " + std::to_string(index) + " is outside the " + std::to_string(available) +
                                                 " correspondences of the adapter");
  }
  checkAllDifferent(name, part, indices, needed);
}

void checkMultiIndices(const char* name, const std::vector<std::vector<int>>& indices, int rays, int points,
                       const hybrid_pose::HybridAdapterBase& adapter) {
  if (indices.size() != 2) throwInvalid(name, "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(indices.size()));
  checkIndices(name, "[0] (2D-2D)", indices[0], rays, adapter.getNumberCorrespondences2d2d());
  checkIndices(name, "[1] (2D-3D)", indices[1], points, adapter.getNumberCorrespondences2d3d());
}

void checkPose(const std::string& name, const FocalPose& pose) {
  constexpr double kTolerance = 1e-6;  // admits rotations that were written with seven digits
  if (!pose.rotation.allFinite() || !pose.position.allFinite()) throwInvalid(name, "not finite");
  const double error = (pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kTolerance) || pose.rotation.determinant() < 0) throwInvalid(name, "its rotation is not a rotation matrix");
  if (!(pose.focalLength > 0) || !std::isfinite(pose.focalLength))
    throwInvalid(name, "its focal length must be positive and finite, is " + std::to_string(pose.focalLength));
}

static void checkFinite(const char* what, int index, const Eigen::Vector3d& value) {
  if (!value.allFinite())
    throwInvalid(
        std::string("adapter.") + what + "(" + std::to_string(index) + ")",
        "not finite: (" + std::to_string(value[0]) + ", " + std::to_string(value[1]) + ", " + std::to_string(value[2]) + ")");
}

// (u, v, w) -> (u/w, v/w)
static Eigen::Vector3d readImagePoint(const char* what, int index, const Eigen::Vector3d& homogeneous) {
  Eigen::Vector3d point = homogeneous[2] == 1 ? homogeneous : Eigen::Vector3d(homogeneous / homogeneous[2]);
  checkFinite(what, index, point);
  return point;
}

solvers::RayMatch readRay(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const auto i = static_cast<std::size_t>(index);
  const Eigen::Vector3d image = readImagePoint("getImagePoint2d2d", index, adapter.getImagePoint2d2d(i));
  const Eigen::Vector3d direction = adapter.getCamRotation(i) * adapter.getBearingVector(i);
  const double length = direction.norm();
  if (!(length > 0) || !std::isfinite(length))
    throwInvalid("adapter.getCamRotation(" + std::to_string(index) + ") * getBearingVector(" + std::to_string(index) + ")",
                 "its length must be positive and finite, is " + std::to_string(length));
  const Eigen::Vector3d centre = adapter.getCamOffset(i);
  checkFinite("getCamOffset", index, centre);
  return {image[0], image[1], centre, direction / length, adapter.getCamIndex(i)};
}

solvers::PointMatch readPoint(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const auto i = static_cast<std::size_t>(index);
  const Eigen::Vector3d image = readImagePoint("getImagePoint2d3d", index, adapter.getImagePoint2d3d(i));
  const Eigen::Vector3d point = adapter.getPoint(i);
  checkFinite("getPoint", index, point);
  return {image[0], image[1], point};
}

}  // namespace hybridgv
