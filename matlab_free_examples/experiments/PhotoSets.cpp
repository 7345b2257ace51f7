#include "PhotoSets.hpp"

#include <hybridgv/adapters/sfm/ModelFiles.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;
using hybridgv::FocalPose;
using hybridgv::sfm::Image;
using hybridgv::sfm::SparseModel;

PhotoMap& mapOf(std::vector<PhotoMap>& maps, const std::string& name, const fs::path& folder) {
  const auto found = std::find_if(maps.begin(), maps.end(), [&](const PhotoMap& map) { return map.name == name; });
  if (found != maps.end()) return *found;
  maps.push_back({name, (folder / name).string(), {}});
  return maps.back();
}

std::vector<PhotoMap> readReferenceFile(const fs::path& folder) {
  const std::string path = (folder / "reference.txt").string();
  std::vector<PhotoMap> maps;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string map;
    PhotoReference query;
    double width = 0, height = 0, k1 = 0, q[4], t[3];
    words >> map >> query.name >> width >> height >> query.pose.focalLength >> k1 >> q[0] >> q[1] >> q[2] >> q[3] >> t[0] >>
        t[1] >> t[2];
    if (!words) throw std::runtime_error(path + ": not a reference: " + line);
    const Eigen::Quaterniond rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    query.pose.rotation = rotation.conjugate().toRotationMatrix();
    query.pose.position = -(query.pose.rotation * Eigen::Vector3d(t[0], t[1], t[2]));
    mapOf(maps, map, folder).queries.push_back(query);
  }
  return maps;
}

// Takes points of the reference's frame to the map's, fitted to the centres of the images that both have. (Two models of the same
// images differ by a similarity, and by their errors.)
Eigen::Affine3d mapFromReference(const SparseModel& map, const SparseModel& reference, const std::string& name) {
  std::vector<Eigen::Vector3d> here, there;
  for (const Image& image : map.images) {
    const Image* same = image.registered ? findPosed(reference, image.name) : nullptr;
    if (same == nullptr) continue;
    here.push_back(image.position);
    there.push_back(same->position);
  }
  if (here.size() < 3) throw std::runtime_error(name + ": fewer than three of its images are in the reference");
  const auto columns = [](const std::vector<Eigen::Vector3d>& points) {
    return Eigen::Map<const Eigen::Matrix3Xd>(points[0].data(), 3, static_cast<Eigen::Index>(points.size()));
  };
  return Eigen::Affine3d(Eigen::umeyama(columns(there), columns(here)));
}

std::set<std::string> readNames(const fs::path& path) {
  std::set<std::string> names;
  std::ifstream in(path);
  for (std::string name; std::getline(in, name);) names.insert(name);
  return names;
}

PhotoMap readMap(const fs::path& path, const SparseModel& reference) {
  PhotoMap map{path.filename().string(), path.string(), {}};
  const SparseModel model = hybridgv::sfm::readModel(map.path);
  const Eigen::Affine3d similarity = mapFromReference(model, reference, map.path);
  const Eigen::Matrix3d rotation = similarity.rotation();
  const std::set<std::string> wanted = readNames(path / "queries.txt");
  for (const Image& image : reference.images) {
    const bool isWanted = wanted.empty() || wanted.count(image.name) != 0;
    if (!isWanted || !image.registered || findPosed(model, image.name) != nullptr) continue;
    FocalPose pose = poseOf(reference, image);
    pose.rotation = rotation * pose.rotation;
    pose.position = similarity * pose.position;
    map.queries.push_back({image.name, pose});
  }
  return map;
}

}  // namespace

const Image* findPosed(const SparseModel& model, const std::string& name) {
  for (const Image& image : model.images)
    if (image.registered && image.name == name) return &image;
  return nullptr;
}

FocalPose poseOf(const SparseModel& model, const Image& image) {
  FocalPose pose;
  pose.rotation = image.rotation;
  pose.position = image.position;
  pose.focalLength = model.cameras[image.camera].parameters[0];
  return pose;
}

std::vector<PhotoMap> readPhotoMaps(const std::string& folder) {
  if (fs::exists(fs::path(folder) / "reference.txt")) return readReferenceFile(folder);
  const SparseModel reference = hybridgv::sfm::readModel((fs::path(folder) / "reference").string());
  std::set<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(folder) / "maps")) paths.insert(entry.path());
  std::vector<PhotoMap> maps;
  maps.reserve(paths.size());
  for (const fs::path& path : paths) maps.push_back(readMap(path, reference));
  if (maps.empty()) throw std::runtime_error(folder + "/maps is empty");
  return maps;
}
