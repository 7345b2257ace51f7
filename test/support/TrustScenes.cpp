#include "TrustScenes.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ImagePointOf = std::function<Vector2d(Random&)>;
using PointOf = std::function<Vector3d(Random&)>;

constexpr double kFocalLength = 1000, kNoise = 1;
constexpr int kCameras = 6;

struct Shape {
  int rays = 100, points = 100;
  double wrongShare = 1;
  ImagePointOf wrongImagePoint;
  PointOf point;
};

Vector2d anywhere(Random& random) {
  const double u = random.uniform(-500, 500), v = random.uniform(-375, 375);
  return {u, v};
}
Vector3d inBox(Random& random) { return random.vector(-5, 5); }

// `count` places, the same in every scene, with points evenly around each.
ImagePointOf clusters(int count, double halfSize) {
  return [=](Random& random) {
    Random place(17, static_cast<std::uint64_t>(random.index(count)));
    const Vector2d centre = anywhere(place);
    const double du = random.uniform(-halfSize, halfSize), dv = random.uniform(-halfSize, halfSize);
    return Vector2d(centre[0] + du, centre[1] + dv);
  };
}

ImagePointOf normal(double deviation) {
  return [=](Random& random) {
    const double u = deviation * random.normal(), v = deviation * random.normal();
    return Vector2d(u, v);
  };
}

Vector3d homogeneous(const Vector2d& p) { return {p[0], p[1], 1}; }

// The query and six rig cameras look at the origin; pair i is wrong if i is below the share.
HybridScene makeScene(const Shape& shape, Random& random) {
  HybridScene scene;
  scene.truth = cameraLookingAtOrigin(random, random.uniform(15, 25), kFocalLength);
  std::vector<FocalPose> rig;
  for (int k = 0; k < kCameras; ++k) {
    rig.push_back(cameraLookingAtOrigin(random, random.uniform(15, 25), kFocalLength));
    scene.offsets.push_back(rig.back().position);
    scene.rotations.push_back(rig.back().rotation);
  }
  const auto imageOf = [&](int i, int count, const Vector3d& point) {
    if (i < std::lround(shape.wrongShare * count)) return homogeneous(shape.wrongImagePoint(random));
    return noisyImagePoint(random, project(scene.truth, point), kNoise);
  };
  for (int i = 0; i < shape.rays; ++i) {
    const Vector3d point = shape.point(random);
    const FocalPose& camera = rig[static_cast<std::size_t>(i % kCameras)];
    const Vector3d inMap = noisyImagePoint(random, project(camera, point), kNoise);
    scene.bearings.push_back(Vector3d(inMap[0], inMap[1], kFocalLength).normalized());
    scene.cameras.push_back(i % kCameras);
    scene.image2d2d.push_back(imageOf(i, shape.rays, point));
  }
  for (int i = 0; i < shape.points; ++i) {
    scene.points.push_back(shape.point(random));
    scene.image2d3d.push_back(imageOf(i, shape.points, scene.points.back()));
  }
  return scene;
}

Shape wrong(ImagePointOf imagePoint, int count = 100) { return {count, count, 1, std::move(imagePoint), inBox}; }
Shape wrongPoints(PointOf point, int count = 100) { return {count, count, 1, anywhere, std::move(point)}; }
Shape partlyWrong(double share, int count, ImagePointOf imagePoint = anywhere, PointOf point = inBox) {
  return {count, count, share, std::move(imagePoint), std::move(point)};
}

TrustCase shaped(std::string name, const Shape& shape) {
  return {std::move(name), [shape](Random& random) { return makeScene(shape, random); }};
}

// The scene with something done to it.
TrustCase changed(std::string name, const Shape& shape, const std::function<void(HybridScene&, Random&)>& change) {
  return {std::move(name), [=](Random& random) {
            HybridScene scene = makeScene(shape, random);
            change(scene, random);
            return scene;
          }};
}

// Every pair is listed `times` times, with noise between the copies.
void repeat(HybridScene& scene, int times, double jitter, Random& random) {
  const HybridScene once = scene;
  const auto near = [&](const Vector3d& image) { return noisyImagePoint(random, image.head<2>(), jitter); };
  for (int copy = 1; copy < times; ++copy) {
    for (std::size_t i = 0; i < once.points.size(); ++i) {
      scene.points.push_back(once.points[i]);
      scene.image2d3d.push_back(near(once.image2d3d[i]));
    }
    for (std::size_t i = 0; i < once.bearings.size(); ++i) {
      scene.bearings.push_back(once.bearings[i]);
      scene.cameras.push_back(once.cameras[i]);
      scene.image2d2d.push_back(near(once.image2d2d[i]));
    }
  }
}

// Few features of the query, each matched to several wrong places of the map.
void shareFeatures(HybridScene& scene, int matches) {
  for (auto* image : {&scene.image2d2d, &scene.image2d3d})
    for (std::size_t i = 0; i < image->size(); ++i) (*image)[i] = (*image)[i - i % static_cast<std::size_t>(matches)];
}

void forImagePoints(HybridScene& scene, const std::function<void(Vector3d&)>& change) {
  for (auto* image : {&scene.image2d2d, &scene.image2d3d})
    for (Vector3d& p : *image) change(p);
}

// Small objects; every image point is that of a point of another object.
TrustCase mismatchedObjects(int count, double radius) {
  return {"ObjectsMistaken" + std::to_string(count), [=](Random& random) {
            std::vector<Vector3d> centres;
            for (int k = 0; k < count; ++k) centres.push_back(inBox(random));
            std::vector<std::size_t> objects;
            const auto point = [&](Random& r) {
              objects.push_back(static_cast<std::size_t>(r.index(count)));
              return Vector3d(centres[objects.back()] + radius * r.direction());
            };
            HybridScene scene = makeScene(partlyWrong(0, 100, anywhere, point), random);
            const auto mistake = [&](std::vector<Vector3d>& image, std::size_t first) {
              const std::vector<Vector3d> right = image;
              for (std::size_t i = 0; i < right.size(); ++i) {
                std::size_t j = i;
                while (objects[first + j] == objects[first + i])
                  j = static_cast<std::size_t>(random.index(static_cast<int>(right.size())));
                image[i] = right[j];
              }
            };
            mistake(scene.image2d2d, 0);
            mistake(scene.image2d3d, scene.image2d2d.size());
            return scene;
          }};
}

// Every point in a plane parallel to the query's image.
TrustCase parallelPlane(std::string name, double wrongShare) {
  return {std::move(name), [=](Random& random) {
            HybridScene scene = makeScene(partlyWrong(0, 60), random);
            const FocalPose& query = scene.truth;
            const auto onPlane = [&] {
              const double x = random.uniform(-8, 8), y = random.uniform(-6, 6);
              return Vector3d(query.position + query.rotation * Vector3d(x, y, 20));
            };
            const auto seen = [&](std::size_t i, std::size_t count, const Vector3d& point) {
              const bool isWrong = static_cast<double>(i) < wrongShare * static_cast<double>(count);
              return noisyImagePoint(random, project(query, isWrong ? onPlane() : point), kNoise);
            };
            for (std::size_t i = 0; i < scene.points.size(); ++i) {
              scene.points[i] = onPlane();
              scene.image2d3d[i] = seen(i, scene.points.size(), scene.points[i]);
            }
            for (std::size_t i = 0; i < scene.bearings.size(); ++i) {
              const auto camera = static_cast<std::size_t>(scene.cameras[i]);
              const Vector3d point = onPlane();
              scene.bearings[i] = (scene.rotations[camera].transpose() * (point - scene.offsets[camera])).normalized();
              scene.image2d2d[i] = seen(i, scene.bearings.size(), point);
            }
            return scene;
          }};
}

std::vector<TrustCase> makeCasesWithoutPose() {
  const Shape even = wrong(anywhere);
  std::vector<TrustCase> cases = {
      shaped("Even", even),
      shaped("Few", wrong(anywhere, 10)),
      shaped("ThreeClusters", wrong(clusters(3, 20), 300)),
      shaped("ManyWindows", wrong(clusters(25, 15), 300)),
      shaped("TwoSmallWindows", wrong(clusters(2, 40), 300)),
      shaped("CrowdedCentre", wrong(normal(50), 300)),
      shaped("HeavyTails", wrong(
                               [](Random& random) {
                                 const double scale = 30 * std::exp(1.5 * random.normal());
                                 const double u = scale * random.normal(), v = scale * random.normal();
                                 return Vector2d(u, v);
                               },
                               300)),
      shaped("Line", wrong(
                         [](Random& random) {
                           const double u = random.uniform(-500, 500), v = random.uniform(-1, 1);
                           return Vector2d(u, v);
                         },
                         300)),
      shaped("Diagonal", wrong(
                             [](Random& random) {
                               const double u = random.uniform(-400, 400);
                               return Vector2d(u, 0.7 * u + random.normal());
                             },
                             300)),
      shaped("Ring", wrong(
                         [](Random& random) {
                           const double angle = random.uniform(0, 2 * Random::kPi), radius = 300 + random.normal();
                           return Vector2d(radius * std::cos(angle), radius * std::sin(angle));
                         },
                         300)),
      shaped("CoarseGrid",
             wrong([](Random& random) { return Vector2d(50 * (random.index(20) - 10), 50 * (random.index(15) - 7)); }, 300)),
      shaped("OnePixel", wrong([](Random& random) { return Vector2d(100 + 0.1 * random.normal(), 50 + 0.1 * random.normal()); })),
      shaped("SmallObject",
             wrongPoints([](Random& random) -> Vector3d { return Vector3d(0.3, 0.2, 0.1) + random.vector(-0.005, 0.005); })),
      shaped("PointsOnALine", wrongPoints([](Random& random) { return Vector3d(random.uniform(-5, 5), 0.3, 0.2); })),
      shaped("PointsInAPlane", wrongPoints(
                                   [](Random& random) {
                                     const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
                                     return Vector3d(x, y, 0.1 * x);
                                   },
                                   300)),
      shaped("TwoSmallObjects", wrongPoints([](Random& random) -> Vector3d {
               return Vector3d(random.index(2) == 0 ? -2 : 2, 1, 0) + random.vector(-0.05, 0.05);
             })),
      changed("FarAway", even,
              [](HybridScene& scene, Random& random) {
                for (Vector3d& point : scene.points) point = Vector3d(800, 700, 0) + 0.5 * random.direction();
              }),
      changed("MatchesSharingFeatures", even, [](HybridScene& scene, Random&) { shareFeatures(scene, 5); }),
      changed("OneRayOften", even,
              [](HybridScene& scene, Random&) {
                for (std::size_t i = 50; i < scene.bearings.size(); ++i) {
                  scene.bearings[i] = scene.bearings[0];
                  scene.cameras[i] = scene.cameras[0];
                }
              }),
      mismatchedObjects(3, 0.5),
      mismatchedObjects(6, 0.3),
  };
  for (const double far : {1e4, 1e5, 1e9})
    cases.push_back(changed("StrayImagePoint1e" + std::to_string(std::lround(std::log10(far))), even,
                            [=](HybridScene& scene, Random&) { scene.image2d3d[0] = Vector3d(far, far, 1); }));
  cases.push_back(changed("ThreeStrayImagePoints", even, [](HybridScene& scene, Random&) {
    for (std::size_t i = 0; i < 3; ++i) scene.image2d2d[i] = Vector3d(3e4, -2e5 * static_cast<double>(i), 1);
  }));
  cases.push_back(changed("StrayPoint", even, [](HybridScene& scene, Random&) { scene.points[0] = Vector3d(1e7, 0, 1e6); }));
  for (const int times : {2, 3, 6})
    cases.push_back(changed("Repeated" + std::to_string(times), {20, 40, 1, anywhere, inBox},
                            [=](HybridScene& scene, Random& random) { repeat(scene, times, 0, random); }));
  for (const double jitter : {0.5, 2.0, 5.0})
    cases.push_back(changed("RepeatedWithNoise" + std::to_string(std::lround(10 * jitter)), {0, 40, 1, anywhere, inBox},
                            [=](HybridScene& scene, Random& random) { repeat(scene, 3, jitter, random); }));
  return cases;
}

std::vector<TrustCase> makeUndeterminedCases() {
  const Shape right = partlyWrong(0.1, 60);
  return {
      parallelPlane("ParallelPlane", 0),
      parallelPlane("ParallelPlaneHalfWrong", 0.5),
      changed("Mirrored", right, [](HybridScene& scene, Random&) { forImagePoints(scene, [](Vector3d& p) { p[1] = -p[1]; }); }),
      changed("AxesSwapped", right,
              [](HybridScene& scene, Random&) { forImagePoints(scene, [](Vector3d& p) { std::swap(p[0], p[1]); }); }),
      changed("PointsBehind", right,
              [](HybridScene& scene, Random&) {
                for (Vector3d& point : scene.points) point = 2 * scene.truth.position - point;
                scene.image2d2d.clear();
                scene.bearings.clear();
                scene.cameras.clear();
              }),
  };
}

std::vector<TrustCase> makeCasesWithPose() {
  const auto small = [](Random& random) { return Vector3d(0.4 * random.vector(-5, 5)); };
  return {
      shaped("HalfWrong", partlyWrong(0.5, 100)),
      shaped("EightOfTenWrong", partlyWrong(0.8, 100)),
      shaped("WrongOnesInClusters", partlyWrong(0.5, 100, clusters(3, 20))),
      shaped("SmallObjectHalfWrong", partlyWrong(0.5, 100, normal(150), small)),
      shaped("TwentyOfEachKind", partlyWrong(0.3, 20)),
      shaped("Exact", partlyWrong(0, 50)),
      changed("StrayImagePoint", partlyWrong(0.5, 100),
              [](HybridScene& scene, Random&) { scene.image2d3d[0] = Vector3d(1e5, 1e5, 1); }),
      changed("Twice", partlyWrong(0.5, 100), [](HybridScene& scene, Random& random) { repeat(scene, 2, 0, random); }),
      changed("FourTimes", partlyWrong(0.4, 60), [](HybridScene& scene, Random& random) { repeat(scene, 4, 0, random); }),
      changed("OnlyPoints", partlyWrong(0.5, 100),
              [](HybridScene& scene, Random&) {
                scene.image2d2d.clear();
                scene.bearings.clear();
                scene.cameras.clear();
              }),
  };
}

}  // namespace

const std::vector<TrustCase>& casesWithoutPose() {
  static const std::vector<TrustCase> cases = makeCasesWithoutPose();
  return cases;
}

const std::vector<TrustCase>& undeterminedCases() {
  static const std::vector<TrustCase> cases = makeUndeterminedCases();
  return cases;
}

const std::vector<TrustCase>& casesWithPose() {
  static const std::vector<TrustCase> cases = makeCasesWithPose();
  return cases;
}

}  // namespace test
}  // namespace hybridgv
