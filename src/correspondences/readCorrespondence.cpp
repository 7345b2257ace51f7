#include "correspondences/readCorrespondence.hpp"

#include <cmath>
#include <string>

#include "CheckArguments.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace correspondences {

static std::string nameOf(const char* what, int index) {
  return std::string("adapter.") + what + "(" + std::to_string(index) + ")";
}

// Names are put together only where an error is reported: this runs for every correspondence.
static void checkFinite(const char* what, int index, const Eigen::Vector3d& value) {
  if (!value.allFinite()) hybridgv::checkFinite(nameOf(what, index), value);
}

// (u, v, w) -> (u/w, v/w)
static Eigen::Vector3d readImagePoint(const char* what, int index, const Eigen::Vector3d& homogeneous) {
  Eigen::Vector3d point = homogeneous[2] == 1 ? homogeneous : Eigen::Vector3d(homogeneous / homogeneous[2]);
  if (!point.allFinite())
    throwInvalid(nameOf(what, index), "must be finite and homogeneous, (u, v, 1), is " + detail::format(homogeneous));
  return point;
}

RayMatch readRay(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const auto i = static_cast<std::size_t>(index);
  const Eigen::Vector3d image = readImagePoint("getImagePoint2d2d", index, adapter.getImagePoint2d2d(i));
  const Eigen::Vector3d direction = adapter.getCamRotation(i) * adapter.getBearingVector(i);
  const double length = direction.norm();
  if (!(length > 0) || !std::isfinite(length))
    throwInvalid(nameOf("getCamRotation", index) + " * " + nameOf("getBearingVector", index),
                 "its length must be positive and finite, is " + detail::format(length));
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
