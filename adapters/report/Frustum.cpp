#include "Frustum.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "CheckArguments.hpp"

namespace hybridgv {
namespace report {
namespace {

double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// At the depth `depth`; of rays that go sideways or backwards, at that distance.
Eigen::Vector3d endOf(const Eigen::Vector3d& ray, double depth) {
  constexpr double kSmallestCosine = 0.2;
  return ray.z() > kSmallestCosine ? Eigen::Vector3d(depth / ray.z() * ray) : Eigen::Vector3d(depth * ray);
}

// Right and lower edge of an image.
std::array<double, 2> sizeOf(const sfm::Camera& camera, const sfm::Image& image) {
  std::array<double, 2> size{static_cast<double>(camera.width), static_cast<double>(camera.height)};
  if (size[0] > 0 && size[1] > 0) return size;
  for (const sfm::Observation& o : image.observations) size = {std::max(size[0], o.x), std::max(size[1], o.y)};
  return size;
}

Frustum frustumOf(const sfm::SparseModel& map, const sfm::Image& image, double depth) {
  const sfm::Camera& camera = map.cameras[image.camera];
  const auto [width, height] = sizeOf(camera, image);
  // Where nothing says how large the image is, its pixels are counted from the principal point.
  const bool isCentred = camera.width == 0 || camera.height == 0;
  const double x[] = {isCentred ? -width : 0, width, width, isCentred ? -width : 0};
  const double y[] = {isCentred ? -height : 0, isCentred ? -height : 0, height, height};
  Frustum frustum{image.position, {}};
  for (std::size_t i = 0; i < frustum.corners.size(); ++i) {
    const std::optional<Eigen::Vector3d> ray = sfm::bearingVector(camera, x[i], y[i]);
    const Eigen::Vector3d direction = ray ? *ray : Eigen::Vector3d::UnitZ();
    frustum.corners[i] = image.position + image.rotation * endOf(direction, depth);
  }
  return frustum;
}

}  // namespace

Extent extentOf(const sfm::SparseModel& map, const std::vector<ReportedImage>& images) {
  std::vector<Eigen::Vector3d> places;
  for (const sfm::Point& point : map.points) places.push_back(point.position);
  for (const sfm::Image& image : map.images)
    if (image.registered) places.push_back(image.position);
  for (const ReportedImage& image : images)
    if (image.success) places.push_back(image.pose.position);
  places.erase(std::remove_if(places.begin(), places.end(), [](const Eigen::Vector3d& p) { return !p.allFinite(); }),
               places.end());
  Extent extent{Eigen::Vector3d::Zero(), 1};
  if (places.empty()) return extent;
  std::vector<double> values(places.size());
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::transform(places.begin(), places.end(), values.begin(), [k](const Eigen::Vector3d& p) { return p[k]; });
    extent.centre[k] = quantile(values, 0.5);
  }
  std::transform(places.begin(), places.end(), values.begin(),
                 [&](const Eigen::Vector3d& p) { return (p - extent.centre).norm(); });
  const double radius = quantile(values, 0.9);
  if (radius > 0 && std::isfinite(radius)) extent.radius = radius;
  return extent;
}

Frustum frustumOf(const ReportedImage& image, double depth) {
  if (!image.pose.position.allFinite() || !image.pose.rotation.allFinite())
    throwInvalid("images", "has a pose that is not finite");
  Frustum frustum{image.pose.position, {}};
  for (std::size_t i = 0; i < frustum.corners.size(); ++i)
    frustum.corners[i] = image.pose.position + image.pose.rotation * endOf(image.corners[i], depth);
  return frustum;
}

std::vector<Frustum> frustaOf(const sfm::SparseModel& map, double depth) {
  std::vector<Frustum> frusta;
  for (const sfm::Image& image : map.images)
    if (image.registered) frusta.push_back(frustumOf(map, image, depth));
  return frusta;
}

}  // namespace report
}  // namespace hybridgv
