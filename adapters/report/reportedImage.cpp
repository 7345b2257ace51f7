#include <algorithm>
#include <cmath>

#include "../sfm/CameraModels.hpp"
#include "../sfm/QueryCamera.hpp"
#include "CheckArguments.hpp"
#include "hybridgv/adapters/report/Page.hpp"

namespace hybridgv {
namespace report {
namespace {

using sac::HybridRansacResult;
using sfm::Camera;
using sfm::LocalizationProblem;

// The camera that was found. A query whose image points were undistorted by its calibration keeps that, and its focal length is scaled.
struct FoundCamera {
  Camera camera;
  double scale = 1;

  std::optional<Eigen::Vector3d> pixel(const Eigen::Vector3d& point) const {
    return sfm::project(camera, {scale * point.x(), scale * point.y(), point.z()});
  }
  Eigen::Vector3d ray(double x, double y) const {
    const std::optional<Eigen::Vector3d> seen = sfm::bearingVector(camera, x, y);
    if (seen) return Eigen::Vector3d(seen->x() / scale, seen->y() / scale, seen->z()).normalized();
    const double f = scale * sfm::focalLength(camera);  // a corner outside of what the lens model describes
    return Eigen::Vector3d(x - static_cast<double>(camera.width) / 2, y - static_cast<double>(camera.height) / 2, f).normalized();
  }
};

bool isInside(const ReportedImage& image, const Eigen::Vector3d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= image.width && pixel.y() <= image.height;
}

// The part of the map's ray that the image shows, thinned to a few points. Along the ray depths grow by a constant factor around the
// distance of the two cameras.
std::vector<sfm::Keypoint> epipolarSegment(const ReportedImage& image, const FoundCamera& camera, const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction) {
  constexpr int kSteps = 96;
  constexpr std::size_t kMostPoints = 9;
  constexpr double kSmallest = 1e-2, kLargest = 1e4;
  const double baseline = std::max((image.pose.position - origin).norm(), 1e-12);
  std::vector<sfm::Keypoint> visible;
  for (int i = 0; i <= kSteps; ++i) {
    const double depth = baseline * kSmallest * std::pow(kLargest / kSmallest, static_cast<double>(i) / kSteps);
    const Eigen::Vector3d point = image.pose.rotation.transpose() * (origin + depth * direction - image.pose.position);
    const std::optional<Eigen::Vector3d> pixel = point.z() > 0 ? camera.pixel(point) : std::nullopt;
    if (pixel && isInside(image, *pixel)) visible.push_back({pixel->x(), pixel->y()});
  }
  if (visible.size() <= kMostPoints) return visible;
  std::vector<sfm::Keypoint> thinned;
  for (std::size_t i = 0; i < kMostPoints; ++i) thinned.push_back(visible[i * (visible.size() - 1) / (kMostPoints - 1)]);
  return thinned;
}

void addPose(const HybridRansacResult& result, const FoundCamera& camera, ReportedImage& image) {
  image.pose = result.pose;
  image.focalLength = camera.scale * sfm::focalLength(camera.camera);
  image.focalLengthStandardDeviation = result.focalLengthStandardDeviation;
  const double x[] = {0, image.width, image.width, 0};
  const double y[] = {0, 0, image.height, image.height};
  for (std::size_t i = 0; i < image.corners.size(); ++i) image.corners[i] = camera.ray(x[i], y[i]);
}

void addEpipolarSegments(const NoncentralHybridAdapter& adapter, const FoundCamera& camera, ReportedImage& image) {
  for (std::size_t i = 0; i < image.marks2d2d.size(); ++i)
    if (image.marks2d2d[i].isInlier)
      image.marks2d2d[i].epipolar =
          epipolarSegment(image, camera, adapter.getCamOffset(i), adapter.getCamRotation(i) * adapter.getBearingVector(i));
}

// `keypoint(i)` is the place of keypoint i of the query.
template <class KeypointAt>
void addMarks(const LocalizationProblem& problem, const HybridRansacResult& result, const KeypointAt& keypoint,
              ReportedImage& image) {
  const auto isInlier = [](const std::vector<char>& inliers, std::size_t i) { return i < inliers.size() && inliers[i] != 0; };
  for (std::size_t i = 0; i < problem.keypoints2d3d.size(); ++i) {
    const auto [x, y] = keypoint(problem.keypoints2d3d[i]);
    image.marks2d3d.push_back({x, y, isInlier(result.inliers2d3d, i), {}});
  }
  for (std::size_t i = 0; i < problem.keypoints2d2d.size(); ++i) {
    const auto [x, y] = keypoint(problem.keypoints2d2d[i]);
    image.marks2d2d.push_back({x, y, isInlier(result.inliers2d2d, i), {}});
  }
}

std::size_t countInliers(const std::vector<Mark>& marks) {
  return static_cast<std::size_t>(std::count_if(marks.begin(), marks.end(), [](const Mark& mark) { return mark.isInlier; }));
}

void countMarks(ReportedImage& image) {
  image.matches2d3d = image.marks2d3d.size();
  image.matches2d2d = image.marks2d2d.size();
  image.inliers2d3d = countInliers(image.marks2d3d);
  image.inliers2d2d = countInliers(image.marks2d2d);
}

// Of an image of unknown size: what its correspondences need.
void setSize(const Camera& camera, ReportedImage& image) {
  image.width = static_cast<double>(camera.width);
  image.height = static_cast<double>(camera.height);
  if (image.width > 0 && image.height > 0) return;
  for (const std::vector<Mark>* marks : {&image.marks2d3d, &image.marks2d2d})
    for (const Mark& mark : *marks) {
      image.width = std::max(image.width, mark.x);
      image.height = std::max(image.height, mark.y);
    }
}

FoundCamera foundCamera(const sfm::QueryImage& query, const sfm::QueryLocalization& localization) {
  if (!localization.distortionIsLost) return {localization.camera, 1};
  return {sfm::distortedCamera(query.camera, localization.result.simpleRadialFocalLength, localization.k1), 1};
}

FoundCamera foundCamera(Camera camera, const LocalizationProblem& problem, const HybridRansacResult& result) {
  if (problem.isUndistorted) return {camera, result.pose.focalLength / sfm::focalLength(camera)};
  sfm::forgetCalibration(camera);
  return {sfm::distortedCamera(camera, result.simpleRadialFocalLength, result.simpleRadialK1), 1};
}

void checkKeypoints(const LocalizationProblem& problem, std::size_t keypoints) {
  for (const std::vector<std::size_t>* indices : {&problem.keypoints2d2d, &problem.keypoints2d3d})
    for (const std::size_t index : *indices)
      if (index >= keypoints) throwInvalid("problem", "names keypoint " + std::to_string(index) + " of another image");
  if (problem.keypoints2d2d.size() != problem.adapter.getNumberCorrespondences2d2d() ||
      problem.keypoints2d3d.size() != problem.adapter.getNumberCorrespondences2d3d())
    throwInvalid("problem", "does not name its keypoints");
}

}  // namespace

ReportedImage reportedImage(const sfm::SparseModel& map, const sfm::QueryImage& query,
                            const sfm::QueryLocalization& localization) {
  checkKeypoints(localization.problem, query.keypoints.size());
  const HybridRansacResult& result = localization.result;
  ReportedImage image;
  image.name = query.name;
  image.success = localization.success;
  image.reason = localization.reason;
  image.seconds = result.seconds;
  addMarks(
      localization.problem, result, [&](std::size_t i) { return query.keypoints[i]; }, image);
  countMarks(image);
  setSize(query.camera, image);
  for (const sfm::PairReport& pair : localization.pairs) {
    if (pair.image >= map.images.size()) throwInvalid("localization", "is of another map");
    image.mapImages.push_back({map.images[pair.image].name, pair.matches, pair.inliers2d2d, pair.inliers2d3d});
  }
  if (!image.success) return image;
  const FoundCamera camera = foundCamera(query, localization);
  addPose(result, camera, image);
  image.k1 = localization.k1;
  image.k1StandardDeviation = localization.k1StandardDeviation;
  addEpipolarSegments(localization.problem.adapter, camera, image);
  return image;
}

ReportedImage reportedImage(const sfm::SparseModel& map, std::size_t imageIndex, const LocalizationProblem& problem,
                            const HybridRansacResult& result) {
  if (imageIndex >= map.images.size()) throwInvalid("imageIndex", "is " + std::to_string(imageIndex));
  const sfm::Image& query = map.images[imageIndex];
  checkKeypoints(problem, query.observations.size());
  ReportedImage image;
  image.name = problem.imageName;
  image.success = result.success;
  image.reason = result.success ? "" : toString(result.failureReason);
  image.seconds = result.seconds;
  const auto observed = [&](std::size_t i) { return sfm::Keypoint{query.observations[i].x, query.observations[i].y}; };
  addMarks(problem, result, observed, image);
  countMarks(image);
  setSize(map.cameras[query.camera], image);
  if (!image.success) return image;
  const FoundCamera camera = foundCamera(map.cameras[query.camera], problem, result);
  addPose(result, camera, image);
  if (!problem.isUndistorted) {
    image.k1 = result.simpleRadialK1;
    image.k1StandardDeviation = result.simpleRadialK1StandardDeviation;
  }
  addEpipolarSegments(problem.adapter, camera, image);
  return image;
}

void addImage(std::vector<ReportedImage>& images, ReportedImage image, std::size_t maxMarks) {
  std::size_t marks = image.matches2d3d + image.matches2d2d;
  for (std::size_t i = images.size(); i > 0 && marks <= maxMarks; --i)
    marks += images[i - 1].matches2d3d + images[i - 1].matches2d2d;
  if (marks > maxMarks) {
    image.marks2d3d = {};
    image.marks2d2d = {};
  }
  images.push_back(std::move(image));
}

}  // namespace report
}  // namespace hybridgv
