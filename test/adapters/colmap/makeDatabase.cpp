// usage: makeDatabase FOLDER [QUERIES [MAP_IMAGES [POINTS [shared]]]]
// Writes a database without images as COLMAP would make it from photographs (database.db), the map of some of these (map/), and
// where the others were taken (truth.txt: NAME F K1 QW QX QY QZ TX TY TZ): images on an arc around a cloud of points, each with its own
// camera (`shared`: the queries have one together), half a pixel of noise, and a tenth of wrong matches.
#include <sys/stat.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

#include "DatabaseFile.hpp"
#include "Random.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace {

using namespace hybridgv;
using sfm::Keypoint;

constexpr std::uint64_t kWidth = 1600, kHeight = 1200;
constexpr double kNoisePx = 0.5, kVisibility = 0.3, kWrongShare = 0.1;
constexpr std::size_t kPartners = 12;  // map images that a query is matched with

// An image with what it sees.
struct Photo {
  sfm::Camera camera;
  sfm::Image image;
  std::vector<Keypoint> keypoints;
  std::map<std::size_t, std::uint32_t> byPoint;  // keypoint of a point
};

sfm::Camera makeCamera(std::uint32_t id, test::Random& random) {
  sfm::Camera camera;
  camera.id = id;
  camera.model = sfm::CameraModel::SimpleRadial;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.parameters = {random.uniform(1100, 2200), kWidth / 2.0, kHeight / 2.0, random.uniform(-0.12, 0.06)};
  return camera;
}

Photo takePhoto(std::uint32_t id, const sfm::Camera& camera, double along, const std::vector<Eigen::Vector3d>& points,
                test::Random& random) {
  Photo photo;
  photo.camera = camera;
  sfm::Image& image = photo.image;
  image.id = id;
  image.name = "photo_" + std::to_string(id) + ".jpg";
  const double angle = 1.6 * (along - 0.5);
  image.position = Eigen::Vector3d(14 * std::sin(angle), random.uniform(-2, 2), -14 * std::cos(angle));
  const Eigen::Vector3d forward = (random.vector(-1, 1) - image.position).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(forward).normalized();
  image.rotation << right, forward.cross(right), forward;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto pixel = sfm::project(photo.camera, image.rotation.transpose() * (points[p] - image.position));
    const bool isInside = pixel && (*pixel)[0] > 0 && (*pixel)[0] < kWidth && (*pixel)[1] > 0 && (*pixel)[1] < kHeight;
    if (!isInside || random.uniform() > kVisibility) continue;
    photo.byPoint.emplace(p, static_cast<std::uint32_t>(photo.keypoints.size()));
    photo.keypoints.push_back({static_cast<float>((*pixel)[0] + kNoisePx * random.normal()),
                               static_cast<float>((*pixel)[1] + kNoisePx * random.normal())});
  }
  return photo;
}

// Matches of two photos, some of them wrong.
std::vector<std::array<std::uint32_t, 2>> match(const Photo& a, const Photo& b, test::Random& random) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (const auto& [point, keypoint] : a.byPoint) {
    const auto other = b.byPoint.find(point);
    if (other == b.byPoint.end()) continue;
    const bool isWrong = random.uniform() < kWrongShare;
    pairs.push_back(
        {keypoint, isWrong ? static_cast<std::uint32_t>(random.index(static_cast<int>(b.keypoints.size()))) : other->second});
  }
  return pairs;
}

// The map: every point that three photos see, at its true place.
sfm::SparseModel makeMap(const std::vector<Photo>& photos, const std::vector<Eigen::Vector3d>& points) {
  sfm::SparseModel map;
  for (const Photo& photo : photos) {
    map.cameras.push_back(photo.camera);
    map.images.push_back(photo.image);
    map.images.back().camera = map.images.size() - 1;
    for (const Keypoint& k : photo.keypoints) map.images.back().observations.push_back({k.x, k.y});
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    sfm::Point point;
    point.id = p + 1;
    point.position = points[p];
    point.error = kNoisePx;
    for (std::size_t i = 0; i < photos.size(); ++i)
      if (photos[i].byPoint.count(p) != 0) point.track.push_back({i, photos[i].byPoint.at(p)});
    if (point.track.size() < 3) continue;
    for (const sfm::TrackElement& e : point.track) map.images[e.image].observations[e.observation].point = map.points.size();
    map.points.push_back(point);
  }
  return map;
}

// COLMAP writes a guess of the focal length.
void store(const Photo& photo, bool isCameraNew, test::DatabaseFile& file) {
  sfm::Camera guess = photo.camera;
  guess.parameters = {1.2 * kWidth, kWidth / 2.0, kHeight / 2.0, 0};
  if (isCameraNew) file.addCamera(guess, false);
  file.addImage(photo.image.id, photo.image.name, photo.camera.id);
  file.addKeypoints(photo.image.id, photo.keypoints);
}

void writeTruth(const Photo& photo, std::ofstream& truth) {
  const Eigen::Quaterniond q(Eigen::Matrix3d(photo.image.rotation.transpose()));
  const Eigen::Vector3d t = -(photo.image.rotation.transpose() * photo.image.position);
  truth << photo.image.name << ' ' << photo.camera.parameters[0] << ' ' << photo.camera.parameters[3] << ' ' << q.w() << ' '
        << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

std::size_t numberAt(int argc, char** argv, int index, std::size_t otherwise) {
  return argc > index ? std::strtoul(argv[index], nullptr, 10) : otherwise;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: makeDatabase FOLDER [QUERIES [MAP_IMAGES [POINTS [shared]]]]\n"), 2;
  const std::string folder = argv[1];
  const std::size_t queries = numberAt(argc, argv, 2, 8), mapImages = numberAt(argc, argv, 3, 10);
  test::Random random(1, 1);
  std::vector<Eigen::Vector3d> points(numberAt(argc, argv, 4, 1500));
  for (Eigen::Vector3d& point : points) point = random.vector(-3, 3);
  mkdir((folder + "/map").c_str(), 0777);
  test::DatabaseFile file(folder + "/database.db");
  file.createTables();
  file.run("BEGIN");

  std::vector<Photo> photos;
  for (std::size_t i = 0; i < mapImages; ++i) {
    const auto id = static_cast<std::uint32_t>(i + 1);
    photos.push_back(takePhoto(id, makeCamera(id, random), (i + 0.5) / mapImages, points, random));
    store(photos.back(), true, file);
  }
  sfm::writeColmapBinary(folder + "/map", makeMap(photos, points));
  std::ofstream truth(folder + "/truth.txt");
  truth.precision(17);
  const bool isShared = argc > 5;
  const sfm::Camera common = makeCamera(static_cast<std::uint32_t>(mapImages + 1), random);
  for (std::size_t i = 0; i < queries; ++i) {
    const double along = random.uniform();
    const auto id = static_cast<std::uint32_t>(mapImages + i + 1);
    const Photo query = takePhoto(id, isShared ? common : makeCamera(id, random), along, points, random);
    store(query, !isShared || i == 0, file);
    writeTruth(query, truth);
    const std::size_t partners = std::min(kPartners, mapImages);
    const auto middle = static_cast<std::size_t>(along * static_cast<double>(mapImages - partners + 1));
    for (std::size_t k = middle; k < middle + partners && k < mapImages; ++k)
      file.addMatches(query.image.id, photos[k].image.id, match(query, photos[k], random));
  }
  file.run("COMMIT");
  return 0;
}
