#include "correspondences/CorrespondenceArrays.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "correspondences/numberCameras.hpp"
#include "correspondences/readCorrespondence.hpp"
#include "math/nthSmallest.hpp"

namespace hybridgv {
namespace correspondences {
namespace {

constexpr std::size_t kRayColumns = 13, kPointColumns = 5;

// Never the largest of several values; 0 if there are none. Changes their order.
double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  return math::nthSmallest(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

// The 95 % quantile, unless that of three quarters is far below it: then it is one of the few far away that must not decide, as where two of
// sixteen are.
double nearlyAllBelow(std::vector<double> values) {
  constexpr double kMostOfQuartile = 4;
  const double most = quantile(values, 0.95), quartile = quantile(values, 0.75);
  return quartile > 0 ? std::min(most, kMostOfQuartile * quartile) : most;
}

double largerCoordinate(double u, double v) { return std::max(std::abs(u), std::abs(v)); }

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

template <class List>
List chosen(const List& list, const std::vector<int>& indices) {
  List result;
  result.reserve(indices.size());
  for (const int index : indices) result.push_back(list[static_cast<std::size_t>(index)]);
  return result;
}

std::vector<int> chosenIfAny(const std::vector<int>& list, const std::vector<int>& indices) {
  return list.empty() ? list : chosen(list, indices);
}

// `count` columns of padded(size) rows, of which those beyond `size` are 0.
UnsetVector<double> columnsOf(std::size_t count, std::size_t size) {
  const std::size_t rows = padded(size);
  UnsetVector<double> columns(count * rows);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = size; i < rows; ++i) columns[k * rows + i] = 0;
  return columns;
}

UnsetVector<double> chosenRows(const UnsetVector<double>& columns, std::size_t count, std::size_t size,
                               const std::vector<int>& indices) {
  const std::size_t from = padded(size), to = padded(indices.size());
  UnsetVector<double> result = columnsOf(count, indices.size());
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < indices.size(); ++i)
      result[k * to + i] = columns[k * from + static_cast<std::size_t>(indices[i])];
  return result;
}

// forRay(i) for all rays and forPoint(i) for all points, in blocks, several of which may be on their way.
template <class ForRay, class ForPoint>
void forAll(std::size_t rays, ForRay forRay, std::size_t points, ForPoint forPoint, const ForEach& forEach) {
  constexpr std::size_t kBlock = 1024;
  const auto blocks = [](std::size_t size) { return static_cast<int>((size + kBlock - 1) / kBlock); };
  const auto inBlock = [](int block, std::size_t size, auto body) {
    const std::size_t begin = static_cast<std::size_t>(block) * kBlock, end = std::min(begin + kBlock, size);
    for (std::size_t i = begin; i < end; ++i) body(i);
  };
  const int ofRays = blocks(rays);
  forEach(ofRays + blocks(points), [&](int block) {
    if (block < ofRays)
      inBlock(block, rays, forRay);
    else
      inBlock(block - ofRays, points, forPoint);
  });
}

}  // namespace

CorrespondenceArrays::CorrespondenceArrays(const Correspondences& correspondences)
    : rayFeatures_(correspondences.rayFeatures), pointFeatures_(correspondences.pointFeatures) {
  resize(correspondences.rays.size(), correspondences.points.size());
  for (std::size_t i = 0; i < rays_.size(); ++i) setRay(i, correspondences.rays[i]);
  for (std::size_t i = 0; i < points_.size(); ++i) setPoint(i, correspondences.points[i]);
  normalize(oneByOne);
}

CorrespondenceArrays::CorrespondenceArrays(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices2d2d,
                                           const std::vector<int>& indices2d3d, const ForEach& forEach)
    : rayFeatures_(indices2d2d.size()), pointFeatures_(indices2d3d.size()) {
  resize(indices2d2d.size(), indices2d3d.size());
  const auto readRay = [&](std::size_t i) {
    setRay(i, readRigRay(adapter, indices2d2d[i]));
    rayFeatures_[i] = adapter.getFeature2d2d(static_cast<std::size_t>(indices2d2d[i]));
  };
  const auto readPointAt = [&](std::size_t i) {
    setPoint(i, readPoint(adapter, indices2d3d[i]));
    pointFeatures_[i] = adapter.getFeature2d3d(static_cast<std::size_t>(indices2d3d[i]));
  };
  forAll(rays_.size(), readRay, points_.size(), readPointAt, adapter.allowsConcurrentReads() ? forEach : ForEach(oneByOne));
  clearIfNoneIsKnown(rayFeatures_);
  clearIfNoneIsKnown(pointFeatures_);
  numberCamerasByCentre(rays_.data(), rays_.size());
  normalize(forEach);
}

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

void CorrespondenceArrays::resize(std::size_t rays, std::size_t points) {
  rays_.resize(rays);
  mapImagePoints_.resize(rays);
  points_.resize(points);
  rayColumns_ = columnsOf(kRayColumns, rays);
  pointColumns_ = columnsOf(kPointColumns, points);
}

void CorrespondenceArrays::normalize(const ForEach& forEach) {
  // Some tell as much as all.
  constexpr std::size_t kEnough = 100;
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < std::min(points_.size(), kEnough); ++i) positions.push_back(points_[i].point);
  for (std::size_t i = 0; i < std::min(rays_.size(), kEnough); ++i) positions.push_back(rays_[i].centre);
  normalization_ = normalizationOf(positions);
  forAll(
      rays_.size(), [&](std::size_t i) { normalizeRay(i); }, points_.size(), [&](std::size_t i) { normalizePoint(i); }, forEach);
}

void CorrespondenceArrays::setRay(std::size_t i, const RigRay& ray) {
  rays_[i] = ray.match;
  mapImagePoints_[i] = ray.mapImagePoint;
  const std::size_t rows = padded(rays_.size());
  const double g = ray.mapImagePoint.focalLength;
  for (std::size_t k = 0; k < 3; ++k) {
    rayColumns_[(5 + k) * rows + i] = ray.epipolar.direction[static_cast<Eigen::Index>(k)];
    rayColumns_[(8 + k) * rows + i] = ray.epipolar.imageNormal[static_cast<Eigen::Index>(k)];
  }
  rayColumns_[11 * rows + i] = g > 0 ? 1 / (g * g) : 0;
  rayColumns_[12 * rows + i] = g > 0 ? 0 : 1;
}

void CorrespondenceArrays::normalizeRay(std::size_t i) {
  RayMatch& match = rays_[i];
  match.centre = normalization_.apply(match.centre);
  const std::size_t rows = padded(rays_.size());
  const double values[5] = {match.u, match.v, match.centre[0], match.centre[1], match.centre[2]};
  for (std::size_t k = 0; k < 5; ++k) rayColumns_[k * rows + i] = values[k];
}

void CorrespondenceArrays::normalizePoint(std::size_t i) {
  PointMatch& match = points_[i];
  match.point = normalization_.apply(match.point);
  const std::size_t rows = padded(points_.size());
  const double values[kPointColumns] = {match.u, match.v, match.point[0], match.point[1], match.point[2]};
  for (std::size_t k = 0; k < kPointColumns; ++k) pointColumns_[k * rows + i] = values[k];
}

template <class Size>
std::vector<double> CorrespondenceArrays::sizesOfImagePoints(const Size& size) const {
  std::vector<double> sizes;
  sizes.reserve(rays_.size() + points_.size());
  for (const RayMatch& match : rays_) sizes.push_back(size(match.u, match.v));
  for (const PointMatch& match : points_) sizes.push_back(size(match.u, match.v));
  return sizes;
}

double CorrespondenceArrays::imageSize() const { return 2 * nearlyAllBelow(sizesOfImagePoints(largerCoordinate)); }

// Of an image that is filled evenly, half of the points have both coordinates below the root of 1/2 of the largest. Of one that is filled along its
// border they have not.
double CorrespondenceArrays::leastImageSize() const {
  std::vector<double> coordinates = sizesOfImagePoints(largerCoordinate);
  return 2 * std::min(nearlyAllBelow(coordinates), std::sqrt(2.) * quantile(coordinates, 0.5));
}

double CorrespondenceArrays::imageRadius() const {
  constexpr double kFarther = 2;
  const std::vector<double> radii = sizesOfImagePoints([](double u, double v) { return std::hypot(u, v); });
  return radii.empty() ? 0 : std::min(kFarther * nearlyAllBelow(radii), *std::max_element(radii.begin(), radii.end()));
}

void CorrespondenceArrays::fixUnknownFocalLengths(double least) {
  const auto isUnknown = [](const MapImagePoint& point) { return !(point.focalLength > 0); };
  if (std::none_of(mapImagePoints_.begin(), mapImagePoints_.end(), isUnknown)) return;
  const double g = std::max(imageSize(), least);
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
