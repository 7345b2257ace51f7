#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string_view>

#include "FileContents.hpp"
#include "ModelLinks.hpp"
#include "NumberWriter.hpp"
#include "Printable.hpp"
#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

Eigen::Vector3d readVector(TextScanner& in, const char* what) {
  const double x = in.number(what), y = in.number(what), z = in.number(what);
  return {x, y, z};
}

Eigen::Vector3d readImagePoint(TextScanner& in) {
  const double u = in.number("u"), v = in.number("v");
  return {u, v, 1};
}

std::vector<std::string_view> linesOf(std::string_view text) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// The lines of a problem file, rig cameras still by their ids.
struct Lines {
  std::optional<FocalPose> reference;
  std::map<std::int64_t, std::size_t> cameraIndices;  // id -> index into centres
  NoncentralHybridAdapter::Vectors centres, imagePoints2d2d, bearings, imagePoints2d3d, points;
  std::vector<std::int64_t> cameraIds;        // of the 2D-2D correspondences
  std::vector<std::size_t> cameraIdLocation;  // their lines in the file
};

void readReference(TextScanner& in, Lines& lines) {
  if (lines.reference) in.fail("there is a second 'query' line");
  FocalPose pose;
  pose.focalLength = in.number("the focal length");
  if (!(pose.focalLength > 0)) in.fail("the focal length must be positive, is " + detail::format(pose.focalLength));
  double q[4];
  for (double& coefficient : q) coefficient = in.number("the quaternion");
  Image image;
  const std::string fault = setPoseFromQuaternion(q, readVector(in, "the translation"), image);
  if (!fault.empty()) in.fail(fault);
  pose.rotation = image.rotation;
  pose.position = image.position;
  lines.reference = pose;
}

void readRigCamera(TextScanner& in, Lines& lines) {
  const auto id = in.integer<std::int64_t>("the camera's id");
  if (!lines.cameraIndices.emplace(id, lines.centres.size()).second) in.fail("camera " + std::to_string(id) + " occurs twice");
  lines.centres.push_back(readVector(in, "the camera's centre"));
}

void readRay(TextScanner& in, Lines& lines) {
  lines.imagePoints2d2d.push_back(readImagePoint(in));
  lines.cameraIds.push_back(in.integer<std::int64_t>("the camera's id"));
  lines.cameraIdLocation.push_back(in.line());
  const Eigen::Vector3d direction = readVector(in, "the ray's direction");
  const double length = direction.stableNorm();
  if (!(length > 0)) in.fail("the ray's direction has length zero");
  lines.bearings.push_back(direction / length);
}

void readPoint(TextScanner& in, Lines& lines) {
  lines.imagePoints2d3d.push_back(readImagePoint(in));
  lines.points.push_back(readVector(in, "the point"));
}

Lines readLines(const std::string& path, Mending& mending) {
  TextScanner in(path, TextScanner::Layout::Lines, mending);
  Lines lines;
  while (in.toNextRecord()) {
    const std::string_view kind = in.word("the kind of line");
    if (kind == "query")
      readReference(in, lines);
    else if (kind == "cam")
      readRigCamera(in, lines);
    else if (kind == "p2")
      readRay(in, lines);
    else if (kind == "p3")
      readPoint(in, lines);
    else
      in.fail("expected query, cam, p2 or p3, found '" + printable(kind) + "'");
    in.endLineOrComment();
  }
  return lines;
}

}  // namespace

bool isProblemFile(const std::string& path) {
  constexpr std::size_t kBytes = 1 << 16;
  const std::string start = readStart(path, kBytes);
  for (const std::string_view line : linesOf(start)) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    const std::string_view word = line.substr(begin, line.find_first_of(" \t\r", begin) - begin);
    return word == "query" || word == "cam" || word == "p2" || word == "p3";
  }
  return false;
}

LocalizationProblem readProblem(const std::string& path, const ReadOptions& options, ReadReport* report) {
  Mending mending(options, report);
  const Lines lines = readLines(path, mending);
  std::vector<int> camIndices;
  for (std::size_t i = 0; i < lines.cameraIds.size(); ++i) {
    const auto camera = lines.cameraIndices.find(lines.cameraIds[i]);
    if (camera == lines.cameraIndices.end())
      throw FileError::atLine(path, lines.cameraIdLocation[i], "there is no camera " + std::to_string(lines.cameraIds[i]));
    camIndices.push_back(static_cast<int>(camera->second));
  }
  const NoncentralHybridAdapter::Matrices rotations(lines.centres.size(), Eigen::Matrix3d::Identity());
  return {std::filesystem::path(path).stem().string(),
          NoncentralHybridAdapter(lines.imagePoints2d2d, lines.bearings, camIndices, lines.centres, rotations,
                                  lines.imagePoints2d3d, lines.points),
          lines.reference,
          {},
          {},
          {},
          std::vector<bool>(lines.imagePoints2d2d.size()),
          std::vector<bool>(lines.imagePoints2d3d.size())};
}

void writeProblem(const std::string& path, const LocalizationProblem& problem) {
  const NoncentralHybridAdapter& adapter = problem.adapter;
  std::string text = "# query f qw qx qy qz tx ty tz | cam id cx cy cz | p3 u v X Y Z | p2 u v camid qx qy qz\n";
  if (problem.reference) {
    const FocalPose& pose = *problem.reference;
    const Eigen::Quaterniond q = Eigen::Quaterniond(Eigen::Matrix3d(pose.rotation.transpose())).normalized();
    text += "query";
    appendNumber(text, pose.focalLength);
    appendNumbers(text, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
    appendNumbers(text, Eigen::Vector3d(-(pose.rotation.transpose() * pose.position)));
    text += '\n';
  }
  std::map<int, Eigen::Vector3d> centres;
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d2d(); ++i)
    centres.emplace(adapter.getCamIndex(i), adapter.getCamOffset(i));
  for (const auto& [camera, centre] : centres) {
    text += "cam";
    appendNumber(text, camera);
    appendNumbers(text, centre);
    text += '\n';
  }
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i) {
    text += "p3";
    appendNumbers(text, Eigen::Vector2d(adapter.getImagePoint2d3d(i).hnormalized()));
    appendNumbers(text, adapter.getPoint(i));
    text += '\n';
  }
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d2d(); ++i) {
    text += "p2";
    appendNumbers(text, Eigen::Vector2d(adapter.getImagePoint2d2d(i).hnormalized()));
    appendNumber(text, adapter.getCamIndex(i));
    appendNumbers(text, Eigen::Vector3d((adapter.getCamRotation(i) * adapter.getBearingVector(i)).normalized()));
    text += '\n';
  }
  writeFile(path, text);
}

}  // namespace sfm
}  // namespace hybridgv
