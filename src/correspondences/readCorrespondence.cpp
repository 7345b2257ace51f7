#include "correspondences/readCorrespondence.hpp"

#include <cmath>
#include <string>

#include "CheckArguments.hpp"

namespace hybridgv {
namespace correspondences {

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

RayMatch readRay(const hybrid_pose::HybridAdapterBase& adapter, int index) {
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

PointMatch readPoint(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const auto i = static_cast<std::size_t>(index);
  const Eigen::Vector3d image = readImagePoint("getImagePoint2d3d", index, adapter.getImagePoint2d3d(i));
  const Eigen::Vector3d point = adapter.getPoint(i);
  checkFinite("getPoint", index, point);
  return {image[0], image[1], point};
}

}  // namespace correspondences
}  // namespace hybridgv
