#include "correspondences/CorrespondenceArrays.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "correspondences/readCorrespondence.hpp"
#include "math/nthSmallest.hpp"

namespace hybridgv {
namespace correspondences {
namespace {

constexpr std::size_t kRayColumns = 13, kPointColumns = 5;

// The place of a quantile.
std::size_t placeOf(double share, const std::vector<double>& values) {
  return static_cast<std::size_t>(share * static_cast<double>(values.size()));
}

// Coordinate-wise median and median distance from it: a few points far away must not decide.
Normalization normalizationOf(const std::vector<Eigen::Vector3d>& positions) {
  Normalization result;
  if (positions.empty()) return result;
  std::vector<double> values(positions.size());
  for (int k = 0; k < 3; ++k) {
    std::transform(positions.begin(), positions.end(), values.begin(), [k](const Eigen::Vector3d& x) { return x[k]; });
    result.centre[k] = math::median(values);
  }
  std::transform(positions.begin(), positions.end(), values.begin(),
                 [&](const Eigen::Vector3d& x) { return (x - result.centre).norm(); });
  const double distance = math::median(values);
  if (distance > 0) result.unit = distance;
  return result;
}

template <class Element>
std::vector<Element> chosen(const std::vector<Element>& list, const std::vector<int>& indices) {
  std::vector<Element> result;
  result.reserve(indices.size());
  for (const int index : indices) result.push_back(list[static_cast<std::size_t>(index)]);
  return result;
}

std::vector<int> chosenIfAny(const std::vector<int>& list, const std::vector<int>& indices) {
  return list.empty() ? list : chosen(list, indices);
}

// Columns of padded(size) rows each.
std::vector<double> chosenRows(const std::vector<double>& columns, std::size_t count, std::size_t size,
                               const std::vector<int>& indices) {
  const std::size_t from = padded(size), to = padded(indices.size());
  std::vector<double> result(count * to, 0);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < indices.size(); ++i)
      result[k * to + i] = columns[k * from + static_cast<std::size_t>(indices[i])];
  return result;
}

}  // namespace

CorrespondenceArrays::CorrespondenceArrays(const Correspondences& correspondences)
    : points_(correspondences.points), rayFeatures_(correspondences.rayFeatures), pointFeatures_(correspondences.pointFeatures) {
  rays_.reserve(correspondences.rays.size());
  mapImagePoints_.reserve(correspondences.rays.size());
  for (const RigRay& ray : correspondences.rays) {
    rays_.push_back(ray.match);
    mapImagePoints_.push_back(ray.mapImagePoint);
  }
  normalize();
  fillRayColumns(correspondences.rays);
  fillPointColumns();
}

CorrespondenceArrays::CorrespondenceArrays(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices2d2d,
                                           const std::vector<int>& indices2d3d)
    : CorrespondenceArrays(readCorrespondences(adapter, indices2d2d, indices2d3d)) {}

CorrespondenceArrays CorrespondenceArrays::subset(const std::vector<int>& rayIndices,
                                                  const std::vector<int>& pointIndices) const {
  CorrespondenceArrays result;
  result.normalization_ = normalization_;
  result.rays_ = chosen(rays_, rayIndices);
  result.points_ = chosen(points_, pointIndices);
  result.mapImagePoints_ = chosen(mapImagePoints_, rayIndices);
  result.rayFeatures_ = chosenIfAny(rayFeatures_, rayIndices);
  result.pointFeatures_ = chosenIfAny(pointFeatures_, pointIndices);
  result.rayColumns_ = chosenRows(rayColumns_, kRayColumns, rays_.size(), rayIndices);
  result.pointColumns_ = chosenRows(pointColumns_, kPointColumns, points_.size(), pointIndices);
  return result;
}

void CorrespondenceArrays::normalize() {
  // Some tell as much as all.
  constexpr std::size_t kEnough = 100;
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < std::min(points_.size(), kEnough); ++i) positions.push_back(points_[i].point);
  for (std::size_t i = 0; i < std::min(rays_.size(), kEnough); ++i) positions.push_back(rays_[i].centre);
  normalization_ = normalizationOf(positions);
  for (PointMatch& match : points_) match.point = normalization_.apply(match.point);
  for (RayMatch& match : rays_) match.centre = normalization_.apply(match.centre);
}

void CorrespondenceArrays::fillRayColumns(const std::vector<RigRay>& rays) {
  const std::size_t rows = padded(rays.size());
  rayColumns_.assign(kRayColumns * rows, 0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayMatch& match = rays_[i];
    const EpipolarRay& ray = rays[i].epipolar;
    const double g = rays[i].mapImagePoint.focalLength;
    double values[kRayColumns] = {match.u, match.v};
    for (int k = 0; k < 3; ++k) {
      values[2 + k] = match.centre[k];
      values[5 + k] = ray.direction[k];
      values[8 + k] = ray.imageNormal[k];
    }
    values[11] = g > 0 ? 1 / (g * g) : 0;
    values[12] = g > 0 ? 0 : 1;
    for (std::size_t k = 0; k < kRayColumns; ++k) rayColumns_[k * rows + i] = values[k];
  }
}

void CorrespondenceArrays::fillPointColumns() {
  const std::size_t rows = padded(points_.size());
  pointColumns_.assign(kPointColumns * rows, 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PointMatch& match = points_[i];
    const double values[kPointColumns] = {match.u, match.v, match.point[0], match.point[1], match.point[2]};
    for (std::size_t k = 0; k < kPointColumns; ++k) pointColumns_[k * rows + i] = values[k];
  }
}

double CorrespondenceArrays::imageSize() const {
  constexpr double kShare = 0.95;
  std::vector<double> coordinates;
  for (const RayMatch& match : rays_) coordinates.push_back(std::max(std::abs(match.u), std::abs(match.v)));
  for (const PointMatch& match : points_) coordinates.push_back(std::max(std::abs(match.u), std::abs(match.v)));
  if (coordinates.empty()) return 0;
  return 2 * math::nthSmallest(coordinates, placeOf(kShare, coordinates));
}

double CorrespondenceArrays::imageRadius() const {
  constexpr double kShare = 0.95, kMostOfQuantile = 2;
  std::vector<double> radii;
  for (const RayMatch& match : rays_) radii.push_back(std::hypot(match.u, match.v));
  for (const PointMatch& match : points_) radii.push_back(std::hypot(match.u, match.v));
  if (radii.empty()) return 0;
  const double quantile = math::nthSmallest(radii, placeOf(kShare, radii));
  return std::min(kMostOfQuantile * quantile, *std::max_element(radii.begin(), radii.end()));
}

void CorrespondenceArrays::fixUnknownFocalLengths() {
  const double g = imageSize();
  if (!(g > 0)) return;
  const std::size_t rows = padded(rays_.size());
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (mapImagePoints_[i].focalLength > 0) continue;
    mapImagePoints_[i].focalLength = g;
    rayColumns_[11 * rows + i] = 1 / (g * g);
    rayColumns_[12 * rows + i] = 0;
  }
}

RayArrays CorrespondenceArrays::rayArrays() const {
  const std::size_t rows = padded(rays_.size());
  const auto column = [&](std::size_t k) { return rayColumns_.data() + k * rows; };
  return {rays_.size(), column(0), column(1), column(2), column(3),  column(4),  column(5),
          column(6),    column(7), column(8), column(9), column(10), column(11), column(12)};
}

PointArrays CorrespondenceArrays::pointArrays() const {
  const std::size_t rows = padded(points_.size());
  const auto column = [&](std::size_t k) { return pointColumns_.data() + k * rows; };
  return {points_.size(), column(0), column(1), column(2), column(3), column(4)};
}

Correspondences Correspondences::subset(const std::vector<int>& rayIndices, const std::vector<int>& pointIndices) const {
  return {chosen(rays, rayIndices), chosen(points, pointIndices), chosenIfAny(rayFeatures, rayIndices),
          chosenIfAny(pointFeatures, pointIndices)};
}

std::size_t padded(std::size_t size) { return (size + kPadding - 1) / kPadding * kPadding; }

std::vector<int> allIndices(std::size_t count) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

}  // namespace correspondences
}  // namespace hybridgv
