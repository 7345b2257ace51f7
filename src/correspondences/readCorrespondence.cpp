#include "correspondences/readCorrespondence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "CheckArguments.hpp"
#include "correspondences/numberCameras.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace correspondences {
namespace {

// Names are put together only where an error is reported: these functions run once per minimal sample.
std::string nameOf(const char* getter, int index) { return std::string("adapter.") + getter + "(" + std::to_string(index) + ")"; }

void checkFinite(const char* getter, int index, const Eigen::Vector3d& value) {
  if (!value.allFinite()) hybridgv::checkFinite(nameOf(getter, index), value);
}

// (u, v, w) -> (u/w, v/w)
Eigen::Vector3d readImagePoint(const char* getter, int index, const Eigen::Vector3d& homogeneous) {
  Eigen::Vector3d point = homogeneous[2] == 1 ? homogeneous : Eigen::Vector3d(homogeneous / homogeneous[2]);
  if (!point.allFinite())
    throwInvalid(nameOf(getter, index), "must be finite and homogeneous, (u, v, 1), is " + detail::format(homogeneous));
  return point;
}

double readFocalLength(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const double g = adapter.getRigFocalLength(static_cast<std::size_t>(index));
  if (!std::isfinite(g) || g < 0) checkNotNegative(nameOf("getRigFocalLength", index), g);
  return g;
}

// A ray with what its two forms are made of.
struct RayReading {
  RayMatch match;
  Eigen::Vector3d bearing;
  Eigen::Matrix3d rotation;
};

RayReading readRay(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const auto i = static_cast<std::size_t>(index);
  RayReading result;
  const Eigen::Vector3d image = readImagePoint("getImagePoint2d2d", index, adapter.getImagePoint2d2d(i));
  result.rotation = adapter.getCamRotation(i);
  if (!isRotation(result.rotation)) checkRotation(nameOf("getCamRotation", index), result.rotation);
  result.bearing = adapter.getBearingVector(i);
  const Eigen::Vector3d direction = result.rotation * result.bearing;
  const double length = direction.norm();
  if (!(length > 0) || !std::isfinite(length))
    throwInvalid(nameOf("getBearingVector", index), "its length must be positive and finite, is " + detail::format(length));
  const Eigen::Vector3d centre = adapter.getCamOffset(i);
  checkFinite("getCamOffset", index, centre);
  result.match = {image[0], image[1], centre, direction / length, adapter.getCamIndex(i)};
  return result;
}

std::size_t checkedCount(const char* getter, std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throwInvalid(std::string("adapter.") + getter + "()", "at most 2^31 - 1 are possible, is " + std::to_string(count));
  return count;
}

template <class Feature>
std::vector<int> readFeatures(const std::vector<int>& indices, Feature featureOf) {
  std::vector<int> features(indices.size());
  std::transform(indices.begin(), indices.end(), features.begin(),
                 [&](int index) { return featureOf(static_cast<std::size_t>(index)); });
  clearIfNoneIsKnown(features);
  return features;
}

double checkedWeight(const char* getter, int index, double weight) {
  if (!std::isfinite(weight)) throwInvalid(nameOf(getter, index), "must be finite, is " + detail::format(weight));
  return weight;
}

}  // namespace

Counts readCounts(const hybrid_pose::HybridAdapterBase& adapter) {
  return {checkedCount("getNumberCorrespondences2d2d", adapter.getNumberCorrespondences2d2d()),
          checkedCount("getNumberCorrespondences2d3d", adapter.getNumberCorrespondences2d3d())};
}

void clearIfNoneIsKnown(std::vector<int>& features) {
  if (std::all_of(features.begin(), features.end(), [](int feature) { return feature < 0; })) features.clear();
}

Correspondences readCorrespondences(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& rayIndices,
                                    const std::vector<int>& pointIndices) {
  Correspondences result;
  result.rays.reserve(rayIndices.size());
  result.points.reserve(pointIndices.size());
  for (const int index : rayIndices) result.rays.push_back(readRigRay(adapter, index));
  for (const int index : pointIndices) result.points.push_back(readPoint(adapter, index));
  numberCamerasByCentre(result.rays);
  result.rayFeatures = readFeatures(rayIndices, [&](std::size_t index) { return adapter.getFeature2d2d(index); });
  result.pointFeatures = readFeatures(pointIndices, [&](std::size_t index) { return adapter.getFeature2d3d(index); });
  return result;
}

RigRay readRigRay(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const RayReading ray = readRay(adapter, index);
  const bool isPinhole = ray.bearing[2] > 0;
  const MapImagePoint inMap{isPinhole ? ray.bearing[0] / ray.bearing[2] : 0, isPinhole ? ray.bearing[1] / ray.bearing[2] : 0,
                            readFocalLength(adapter, index)};
  return {ray.match, makeEpipolarRay(ray.bearing, ray.rotation), inMap};
}

PointMatch readPoint(const hybrid_pose::HybridAdapterBase& adapter, int index) {
  const auto i = static_cast<std::size_t>(index);
  const Eigen::Vector3d image = readImagePoint("getImagePoint2d3d", index, adapter.getImagePoint2d3d(i));
  const Eigen::Vector3d point = adapter.getPoint(i);
  checkFinite("getPoint", index, point);
  return {image[0], image[1], point};
}

void readSampleRays(const hybrid_pose::HybridAdapterBase& adapter, const int* indices, int count, RayMatch* rays) {
  for (int i = 0; i < count; ++i) rays[i] = readRay(adapter, indices[i]).match;
  numberCamerasOfSample(rays, count);
}

void readSamplePoints(const hybrid_pose::HybridAdapterBase& adapter, const int* indices, int count, PointMatch* points) {
  for (int i = 0; i < count; ++i) points[i] = readPoint(adapter, indices[i]);
}

std::vector<double> readRayWeights(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  std::vector<double> weights;
  weights.reserve(indices.size());
  for (const int index : indices)
    weights.push_back(checkedWeight("getWeight2d2d", index, adapter.getWeight2d2d(static_cast<std::size_t>(index))));
  return weights;
}

std::vector<double> readPointWeights(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  std::vector<double> weights;
  weights.reserve(indices.size());
  for (const int index : indices)
    weights.push_back(checkedWeight("getWeight2d3d", index, adapter.getWeight2d3d(static_cast<std::size_t>(index))));
  return weights;
}

}  // namespace correspondences
}  // namespace hybridgv
