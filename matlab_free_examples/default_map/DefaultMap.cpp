#include "DefaultMap.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "math/RandomStream.hpp"

namespace {

using namespace hybridgv::sfm;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kImages = 16;
constexpr std::size_t kPoints = 1100;

// The building: a box on the ground, 22 m wide, 14 m deep, 11 m high; x to the right along the front, y into the building, z up.
const Vector3d kLow(-11, 0, 0), kHigh(11, 14, 11);

class Random : public hybridgv::math::SplitMix64 {
 public:
  using SplitMix64::SplitMix64;
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform(1e-16, 1)));
    return radius * std::cos(2 * kPi * uniform());
  }
};

// To a number of decimals, so that the value is short in the file.
double rounded(double value, double perUnit) { return std::round(value * perUnit) / perUnit; }

// A corner of the texture, with the outward normal of the surface that carries it.
struct SurfacePoint {
  Vector3d position, normal;
  std::array<std::uint8_t, 3> colour;
};

// Windows every 2.75 m are recessed by 0.25 m, balconies stick out by 1.1 m, other corners lie on the wall and its mouldings.
double reliefDepth(double along, double height, Random& random) {
  const bool window = std::fmod(along + 40, 2.75) < 1.2 && std::fmod(height, 3.4) > 1.1 && std::fmod(height, 3.4) < 2.7;
  if (window) return -0.25;
  const bool balcony = std::fmod(height, 3.4) < 0.9 && height > 3.4 && std::fmod(along + 40, 5.5) < 1.9;
  return balcony ? 1.1 : random.uniform(0, 0.12);
}

SurfacePoint makeSurfacePoint(Random& random) {
  const double kind = random.uniform(0, 1), height = random.uniform(0.2, kHigh[2]);
  if (kind < 0.46) {  // front
    const double x = random.uniform(kLow[0], kHigh[0]);
    return {{x, -reliefDepth(x, height, random), height}, {0, -1, 0}, {186, 170, 140}};
  }
  if (kind < 0.68) {  // right side
    const double y = random.uniform(kLow[1], kHigh[1]);
    return {{kHigh[0] + reliefDepth(y, height, random), y, height}, {1, 0, 0}, {164, 150, 128}};
  }
  if (kind < 0.80) {  // roof, leaning towards the front
    const double x = random.uniform(kLow[0], kHigh[0]), y = random.uniform(0, 4);
    return {{x, y, kHigh[2] + 0.7 * y}, Vector3d(0, -0.7, 1).normalized(), {120, 66, 52}};
  }
  if (kind < 0.92) {  // ground in front
    return {{random.uniform(-13, 16), random.uniform(-9, -1), random.uniform(0, 0.05)}, {0, 0, 1}, {110, 112, 105}};
  }
  // lamp posts and a statue in front of the building
  const double post = static_cast<double>(random.below(4));
  return {{-9 + 7 * post + random.uniform(-0.3, 0.3), -5 + 0.6 * post, random.uniform(0.3, 4)}, {0, -1, 0}, {70, 72, 76}};
}

Camera makeCamera(std::size_t index, Random& random) {
  const bool portrait = index % 5 == 3, large = index % 3 == 0;
  const double wide = large ? 1600 : 1024, high = large ? 1200 : 768;
  Camera camera;
  camera.id = static_cast<std::uint32_t>(index + 1);
  camera.width = static_cast<std::uint64_t>(portrait ? high : wide);
  camera.height = static_cast<std::uint64_t>(portrait ? wide : high);
  const double f = rounded(wide * random.uniform(large ? 0.62 : 0.55, 1.0), 100);
  const double cx = static_cast<double>(camera.width) / 2, cy = static_cast<double>(camera.height) / 2;
  const double k1 = rounded(random.uniform(-0.12, 0.03), 1e4), k2 = rounded(random.uniform(0, 0.03), 1e4);
  switch (index % 5) {
    case 0:
    case 1:
      camera.model = CameraModel::SimpleRadial;
      camera.parameters = {f, cx, cy, k1};
      break;
    case 2:
      camera.model = CameraModel::Radial;
      camera.parameters = {f, cx, cy, k1, k2};
      break;
    case 3:
      camera.model = CameraModel::SimplePinhole;
      camera.parameters = {f, cx, cy};
      break;
    default:
      camera.model = CameraModel::OpenCV;
      camera.parameters = {f, rounded(1.002 * f, 100), cx + 4.5, cy - 3.25, k1, k2, 0.0006, -0.0004};
  }
  return camera;
}

// Photographers stop at a few places around the front and the right corner and take several images at each, at eye height or from
// a window across the street.
Image makeImage(std::size_t index, Random& random) {
  constexpr std::size_t kPlaces = 6;
  Image image;
  image.id = static_cast<std::uint32_t>(index + 1);
  image.name = "photo_" + std::string(index < 9 ? "0" : "") + std::to_string(index + 1) + ".jpg";
  image.camera = index;
  const double place = static_cast<double>(index * kPlaces / kImages) / (kPlaces - 1);
  const double turn = (-105 + 60 * place + random.uniform(-4, 4)) * kPi / 180;
  const double distance = random.uniform(20, 28);
  const double height = index % 4 == 1 ? random.uniform(5, 8) : random.uniform(1.5, 2);
  image.position = Vector3d(3 + distance * std::cos(turn), 3 + distance * std::sin(turn), height);
  const Vector3d target{random.uniform(-2, 7), random.uniform(0, 3), random.uniform(3.5, 6)};  // braces: evaluated in this order
  const Vector3d forward = (target - image.position).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  image.rotation << right, forward.cross(right), forward;
  image.rotation *= Eigen::AngleAxisd(random.normal() * 3 * kPi / 180, Vector3d::UnitZ()).toRotationMatrix();
  return image;
}

// Does the building hide the point? The segment from the camera is cut with the box's slabs.
bool isHidden(const Vector3d& camera, const Vector3d& point) {
  const Vector3d inner(0.3, 0.3, 0.3);
  double enter = 0, leave = 0.98;
  for (int axis = 0; axis < 3; ++axis) {
    const double slope = point[axis] - camera[axis];
    double a = (kLow[axis] + inner[axis] - camera[axis]) / slope, b = (kHigh[axis] - inner[axis] - camera[axis]) / slope;
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a);
    leave = std::min(leave, b);
  }
  return enter < leave;
}

// The exact pixel, if the image can show the point.
std::optional<Vector3d> project(const Camera& camera, const Image& image, const SurfacePoint& point) {
  const Vector3d sight = image.position - point.position;
  if (sight.normalized().dot(point.normal) < 0.2 || isHidden(image.position, point.position)) return std::nullopt;
  const Vector3d p = image.rotation.transpose() * (point.position - image.position);
  if (p[2] < 1) return std::nullopt;
  const double f = focalLength(camera);
  const std::optional<Vector3d> pixel = distort(camera, {f * p[0] / p[2], f * p[1] / p[2], 1});
  const bool inside = pixel && (*pixel)[0] > 3 && (*pixel)[1] > 3 && (*pixel)[0] < static_cast<double>(camera.width) - 3 &&
                      (*pixel)[1] < static_cast<double>(camera.height) - 3;
  return inside ? pixel : std::nullopt;
}

// The images in which matching finds the point again: those that look at it from nearly the same side as a first one.
std::vector<std::size_t> chooseViewers(const std::vector<Image>& images, const std::vector<std::size_t>& visible,
                                       const SurfacePoint& point, Random& random) {
  constexpr double kWidestAngle = 14 * kPi / 180;
  const std::size_t first = visible[random.below(visible.size())];
  const double luck = random.uniform(0.05, 0.6);  // how distinctive the point is
  std::vector<std::size_t> result;
  for (const std::size_t i : visible) {
    const Vector3d a = (images[i].position - point.position).normalized(),
                   b = (images[first].position - point.position).normalized();
    const bool found = random.uniform(0, 1) < luck;
    if (i == first || (found && std::acos(std::min(1.0, a.dot(b))) < kWidestAngle)) result.push_back(i);
  }
  return result;
}

// The point nearest to the viewing rays, each weighted by its precision f / depth: nearly the least-squares point in the images.
Vector3d triangulate(const SparseModel& model, const std::vector<TrackElement>& track, const Vector3d& start) {
  Vector3d point = start;
  for (int iteration = 0; iteration < 3; ++iteration) {
    Matrix3d A = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    for (const TrackElement& e : track) {
      const Image& image = model.images[e.image];
      const Camera& camera = model.cameras[image.camera];
      const Observation& o = image.observations[e.observation];
      const double f = focalLength(camera);
      Vector3d ray = *undistort(camera, o.x, o.y);
      ray[2] = f;
      ray = (image.rotation * ray).normalized();
      const double precision = f / (point - image.position).norm();
      const Matrix3d across = precision * precision * (Matrix3d::Identity() - ray * ray.transpose());
      A += across;
      b += across * image.position;
    }
    point = A.ldlt().solve(b);
  }
  return point;
}

// Mean distance [px] of the observations from the projections of the point.
double meanError(const SparseModel& model, const Point& point) {
  double sum = 0;
  for (const TrackElement& e : point.track) {
    const Image& image = model.images[e.image];
    const Camera& camera = model.cameras[image.camera];
    const Observation& o = image.observations[e.observation];
    const Vector3d p = image.rotation.transpose() * (point.position - image.position);
    const double f = focalLength(camera);
    const Vector3d pixel = *distort(camera, {f * p[0] / p[2], f * p[1] / p[2], 1});
    sum += std::hypot(pixel[0] - o.x, pixel[1] - o.y);
  }
  return sum / static_cast<double>(point.track.size());
}

void addPoint(SparseModel& model, const SurfacePoint& surface, const std::vector<std::size_t>& viewers, Random& random) {
  Point point;
  point.id = model.points.size() + 1;
  const double sigma = random.uniform(0.5, 1.0);  // [px]
  for (const std::size_t i : viewers) {
    const Vector3d pixel = *project(model.cameras[i], model.images[i], surface);
    std::vector<Observation>& observations = model.images[i].observations;
    const double x = pixel[0] + sigma * random.normal(), y = pixel[1] + sigma * random.normal();
    point.track.push_back({i, observations.size()});
    observations.push_back({rounded(x, 100), rounded(y, 100), model.points.size()});
  }
  for (int axis = 0; axis < 3; ++axis)
    point.position[axis] = rounded(triangulate(model, point.track, surface.position)[axis], 1e4);
  point.error = rounded(meanError(model, point), 1000);
  for (int i = 0; i < 3; ++i)
    point.colour[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(surface.colour[static_cast<std::size_t>(i)] + random.below(40) - 20);
  model.points.push_back(std::move(point));
}

}  // namespace

SparseModel makeDefaultMap(std::uint64_t seed) {
  Random random(seed);
  SparseModel model;
  for (std::size_t i = 0; i < kImages; ++i) {
    model.cameras.push_back(makeCamera(i, random));
    model.images.push_back(makeImage(i, random));
  }
  while (model.points.size() < kPoints) {
    const SurfacePoint surface = makeSurfacePoint(random);
    std::vector<std::size_t> visible;
    for (std::size_t i = 0; i < kImages; ++i)
      if (project(model.cameras[i], model.images[i], surface)) visible.push_back(i);
    if (visible.size() < 2) continue;
    const std::vector<std::size_t> viewers = chooseViewers(model.images, visible, surface, random);
    if (viewers.size() >= 2) addPoint(model, surface, viewers, random);
  }
  return model;
}
