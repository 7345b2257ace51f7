#include <algorithm>

#include "../sfm/FileContents.hpp"
#include "Frustum.hpp"
#include "Json.hpp"
#include "PageImages.hpp"
#include "PageTemplate.hpp"
#include "hybridgv/adapters/report/Page.hpp"

namespace hybridgv {
namespace report {
namespace {

std::string jsonCount(std::size_t value) { return std::to_string(value); }

void append(const Eigen::Vector3d& v, std::vector<float>& values) {
  for (Eigen::Index k = 0; k < 3; ++k) values.push_back(static_cast<float>(v[k]));
}

// Centre and corners, 15 numbers for each. Places are told from the middle of the map, where single precision is enough.
std::string frusta(const std::vector<Frustum>& all, const Extent& extent) {
  std::vector<float> values;
  for (const Frustum& frustum : all) {
    append(frustum.centre - extent.centre, values);
    for (const Eigen::Vector3d& corner : frustum.corners) append(corner - extent.centre, values);
  }
  return jsonArray(values);
}

// Every `stride`-th point.
void addPoints(const sfm::SparseModel& map, const Extent& extent, std::size_t stride, JsonList& json) {
  std::vector<float> places;
  std::vector<std::uint8_t> colours;
  for (std::size_t i = 0; i < map.points.size(); i += stride) {
    const sfm::Point& point = map.points[i];
    if (!point.position.allFinite()) continue;
    append(point.position - extent.centre, places);
    colours.insert(colours.end(), point.colour.begin(), point.colour.end());
  }
  json.add("points", jsonArray(places));
  json.add("colours", jsonArray(colours));
  json.add("numberPoints", jsonCount(map.points.size()));
  json.add("stride", jsonCount(stride));
}

// The mean of the map cameras' upward directions.
std::string upward(const sfm::SparseModel& map) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const sfm::Image& image : map.images)
    if (image.registered && image.rotation.allFinite()) up -= image.rotation.col(1);
  if (up.norm() < 1e-9) up = -Eigen::Vector3d::UnitY();
  std::vector<float> values;
  append(up.normalized(), values);
  return jsonArray(values);
}

void addMarks(const char* kind, const std::vector<Mark>& marks, JsonList& json) {
  std::vector<float> places, segments;
  std::vector<std::uint8_t> inliers, lengths;
  for (const Mark& mark : marks) {
    places.insert(places.end(), {static_cast<float>(mark.x), static_cast<float>(mark.y)});
    inliers.push_back(mark.isInlier ? 1 : 0);
    lengths.push_back(static_cast<std::uint8_t>(mark.epipolar.size()));
    for (const sfm::Keypoint& k : mark.epipolar)
      segments.insert(segments.end(), {static_cast<float>(k.x), static_cast<float>(k.y)});
  }
  json.add(std::string("marks") + kind, jsonArray(places));
  json.add(std::string("inliers") + kind, jsonArray(inliers));
  if (segments.empty()) return;
  json.add("segments", jsonArray(segments));
  json.add("lengths", jsonArray(lengths));
}

void addPose(const ReportedImage& image, const Extent& extent, JsonList& json) {
  std::vector<float> pose;
  append(image.pose.position - extent.centre, pose);
  for (Eigen::Index column = 0; column < 3; ++column) append(image.pose.rotation.col(column), pose);
  json.add("pose", jsonArray(pose));
  json.add("focalLength", jsonNumber(image.focalLength));
  json.add("focalLengthDeviation", jsonNumber(image.focalLengthStandardDeviation));
  json.add("k1", jsonNumber(image.k1));
  json.add("k1Deviation", jsonNumber(image.k1StandardDeviation));
}

std::string mapImages(const std::vector<MapImageShare>& shares) {
  JsonList list(false);
  for (const MapImageShare& share : shares) {
    JsonList json(true);
    json.add("name", jsonString(share.name));
    json.add("matches", jsonCount(share.matches));
    json.add("inliers2d3d", jsonCount(share.inliers2d3d));
    json.add("inliers2d2d", jsonCount(share.inliers2d2d));
    list.add(json.text());
  }
  return list.text();
}

std::string imageJson(const ReportedImage& image, const Extent& extent, bool hasMarks, const std::string& address) {
  JsonList json(true);
  json.add("name", jsonString(image.name));
  json.add("success", image.success ? "true" : "false");
  json.add("reason", jsonString(image.reason));
  json.add("width", jsonNumber(image.width));
  json.add("height", jsonNumber(image.height));
  json.add("seconds", jsonNumber(image.seconds));
  json.add("number2d3d", jsonCount(image.matches2d3d));
  json.add("number2d2d", jsonCount(image.matches2d2d));
  json.add("good2d3d", jsonCount(image.inliers2d3d));
  json.add("good2d2d", jsonCount(image.inliers2d2d));
  json.add("mapImages", mapImages(image.mapImages));
  if (image.success) addPose(image, extent, json);
  if (!address.empty()) json.add("address", jsonString(address));
  const bool isComplete = image.marks2d3d.size() == image.matches2d3d && image.marks2d2d.size() == image.matches2d2d;
  if (!hasMarks || !isComplete) return json.text();
  addMarks("2d3d", image.marks2d3d, json);
  addMarks("2d2d", image.marks2d2d, json);
  return json.text();
}

std::vector<Frustum> queryFrusta(const std::vector<ReportedImage>& images, double depth) {
  std::vector<Frustum> found;
  for (const ReportedImage& image : images)
    if (image.success) found.push_back(frustumOf(image, depth));
  return found;
}

std::string pageData(const std::string& path, const sfm::SparseModel& map, const std::vector<ReportedImage>& images,
                     const PageOptions& options) {
  constexpr double kFrustumDepth = 0.05;  // of the scene's width
  const Extent extent = extentOf(map, images);
  const double depth = kFrustumDepth * 2 * extent.radius;
  const std::size_t most = std::max<std::size_t>(options.maxPoints, 1);
  JsonList json(true);
  json.add("title", jsonString(options.title));
  json.add("radius", jsonNumber(extent.radius));
  json.add("up", upward(map));
  addPoints(map, extent, std::max<std::size_t>((map.points.size() + most - 1) / most, 1), json);
  json.add("mapCameras", frusta(frustaOf(map, depth), extent));
  json.add("queryCameras", frusta(queryFrusta(images, depth), extent));
  PageImages addresses(path, options);
  JsonList list(false);
  std::size_t marks = 0;
  for (const ReportedImage& image : images) {
    marks += image.matches2d2d + image.matches2d3d;
    list.add(imageJson(image, extent, marks <= options.maxMarks, addresses.addressOf(image.name)));
  }
  json.add("images", list.text());
  return json.text();
}

}  // namespace

std::string makePage(const std::string& path, const sfm::SparseModel& map, const std::vector<ReportedImage>& images,
                     const PageOptions& options) {
  return std::string(kPageStart) + pageData(path, map, images, options) + kPageEnd;
}

void writePage(const std::string& path, const sfm::SparseModel& map, const std::vector<ReportedImage>& images,
               const PageOptions& options) {
  sfm::replaceFile(path, makePage(path, map, images, options));
}

}  // namespace report
}  // namespace hybridgv
