#include "correspondences/CorrespondenceArrays.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "CheckArguments.hpp"
#include "correspondences/EpipolarRay.hpp"
#include "correspondences/readCorrespondence.hpp"

namespace hybridgv {
namespace correspondences {
namespace {

constexpr std::size_t kRayColumns = 13, kPointColumns = 5;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Coordinate-wise median and median distance from it: a few points far away must not decide.
Normalization normalizationOf(const std::vector<Eigen::Vector3d>& positions) {
  Normalization result;
  if (positions.empty()) return result;
  std::vector<double> values(positions.size());
  for (int k = 0; k < 3; ++k) {
    std::transform(positions.begin(), positions.end(), values.begin(), [k](const Eigen::Vector3d& x) { return x[k]; });
    result.centre[k] = median(values);
  }
  std::transform(positions.begin(), positions.end(), values.begin(),
                 [&](const Eigen::Vector3d& x) { return (x - result.centre).norm(); });
  const double distance = median(values);
  if (distance > 0) result.unit = distance;
  return result;
}

}  // namespace

CorrespondenceArrays::CorrespondenceArrays(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices2d2d,
                                           const std::vector<int>& indices2d3d) {
  rays_.reserve(indices2d2d.size());
  points_.reserve(indices2d3d.size());
  for (const int index : indices2d2d) rays_.push_back(readRay(adapter, index));
  for (const int index : indices2d3d) points_.push_back(readPoint(adapter, index));
  normalize();
  fillRayColumns(adapter, indices2d2d);
  fillPointColumns();
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

void CorrespondenceArrays::fillRayColumns(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices2d2d) {
  const std::size_t rows = padded(rays_.size());
  rayColumns_.assign(kRayColumns * rows, 0);
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const auto index = static_cast<std::size_t>(indices2d2d[i]);
    const Eigen::Vector3d bearing = adapter.getBearingVector(index);
    const double g = adapter.getRigFocalLength(index);
    if (!std::isfinite(g) || g < 0) checkNotNegative("adapter.getRigFocalLength(" + std::to_string(index) + ")", g);
    const bool isPinhole = bearing[2] > 0;
    mapImagePoints_.push_back({isPinhole ? bearing[0] / bearing[2] : 0, isPinhole ? bearing[1] / bearing[2] : 0, g});

    const RayMatch& match = rays_[i];
    const EpipolarRay ray = makeEpipolarRay(bearing, adapter.getCamRotation(index));
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

void CorrespondenceArrays::boundUnknownFocalLengths() {
  const auto add = [this](double u, double v) {
    leastFocalLength_ = std::max({leastFocalLength_, 2 * std::abs(u), 2 * std::abs(v)});
  };
  for (const RayMatch& match : rays_) add(match.u, match.v);
  for (const PointMatch& match : points_) add(match.u, match.v);
}

RayArrays CorrespondenceArrays::rayArrays() const {
  const std::size_t rows = padded(rays_.size());
  const auto column = [&](std::size_t k) { return rayColumns_.data() + k * rows; };
  return {rays_.size(), leastFocalLength_, column(0), column(1), column(2),  column(3),  column(4), column(5),
          column(6),    column(7),         column(8), column(9), column(10), column(11), column(12)};
}

PointArrays CorrespondenceArrays::pointArrays() const {
  const std::size_t rows = padded(points_.size());
  const auto column = [&](std::size_t k) { return pointColumns_.data() + k * rows; };
  return {points_.size(), column(0), column(1), column(2), column(3), column(4)};
}

std::size_t padded(std::size_t size) { return (size + kPadding - 1) / kPadding * kPadding; }

std::vector<int> allIndices(std::size_t count) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

}  // namespace correspondences
}  // namespace hybridgv
