// Scenes whose points fill the query's image, as lens distortion needs them to be seen, through a lens that may have distortion.
#pragma once

#include <cmath>
#include <functional>

#include "HybridScene.hpp"
#include "hybridgv/distortion.hpp"

namespace hybridgv {
namespace test {

// Where the query sees the direction (x, y, 1), for its focal length [px]; far outside of the image if nowhere.
using QueryLens = std::function<Eigen::Vector2d(const Eigen::Vector2d& direction, double focalLength)>;

// COLMAP's SIMPLE_RADIAL, as far as it is monotonic.
inline QueryLens simpleRadialLens(double k1) {
  return [k1](const Eigen::Vector2d& direction, double focalLength) -> Eigen::Vector2d {
    const double r2 = direction.squaredNorm();
    return 1 + 3 * k1 * r2 > 0.1 ? focalLength * (1 + k1 * r2) * direction : Eigen::Vector2d(1e9, 1e9);
  };
}

// Division model.
inline QueryLens divisionLens(double distortion) {
  return [distortion](const Eigen::Vector2d& direction, double focalLength) -> Eigen::Vector2d {
    const auto seen = distort(distortion, {focalLength * direction[0], focalLength * direction[1], 1});
    return seen ? Eigen::Vector2d(seen->head<2>()) : Eigen::Vector2d(1e9, 1e9);
  };
}

struct WideSceneOptions {
  int rays = 100, points = 100, cameras = 6;
  double imageNoise = 1;  // [px] standard deviation per coordinate, query and map images
  double outlierShare = 0;
  QueryLens lens = simpleRadialLens(0);
};

constexpr double kWideHalfSize = 500;

// The image is 1000 px wide, the focal length 700 to 1400 px.
inline HybridScene makeWideScene(Random& random, const WideSceneOptions& options) {
  HybridScene scene;
  scene.truth = cameraLookingAtOrigin(random, random.uniform(10, 18), random.uniform(700, 1400));
  for (int k = 0; k < options.cameras; ++k) {
    const FocalPose camera = cameraLookingAtOrigin(random, random.uniform(10, 18), kRigFocalLength);
    scene.offsets.push_back(camera.position);
    scene.rotations.push_back(camera.rotation);
  }
  // A point and where it is seen.
  struct Seen {
    Eigen::Vector3d point, image;
  };
  const auto seen = [&]() -> Seen {
    for (;;) {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), depth = random.uniform(5, 17);
      const Eigen::Vector2d direction = 1.3 * kWideHalfSize / scene.truth.focalLength * Eigen::Vector2d(x, y);
      const Eigen::Vector2d exact = options.lens(direction, scene.truth.focalLength);
      if (exact.cwiseAbs().maxCoeff() > kWideHalfSize) continue;
      const Eigen::Vector3d inQuery(depth * direction[0], depth * direction[1], depth);
      return {scene.truth.position + scene.truth.rotation * inQuery, noisyImagePoint(random, exact, options.imageNoise)};
    }
  };
  for (int i = 0; i < options.rays; ++i) {
    const int k = i % options.cameras;
    FocalPose camera;
    camera.rotation = scene.rotations[static_cast<std::size_t>(k)];
    camera.position = scene.offsets[static_cast<std::size_t>(k)];
    camera.focalLength = kRigFocalLength;
    Seen ray = seen();
    while (toCamera(camera, ray.point)[2] < 1) ray = seen();
    const bool inlier = i >= std::lround(options.outlierShare * options.rays);
    const Eigen::Vector3d inMap = noisyImagePoint(random, project(camera, ray.point), options.imageNoise);
    scene.image2d2d.push_back(inlier ? ray.image : randomImagePoint(random));
    scene.bearings.push_back(Eigen::Vector3d(inMap[0], inMap[1], kRigFocalLength).normalized());
    scene.cameras.push_back(k);
    scene.inliers2d2d.push_back(inlier);
  }
  for (int i = 0; i < options.points; ++i) {
    const Seen point = seen();
    const bool inlier = i >= std::lround(options.outlierShare * options.points);
    scene.image2d3d.push_back(inlier ? point.image : randomImagePoint(random));
    scene.points.push_back(point.point);
    scene.inliers2d3d.push_back(inlier);
  }
  return scene;
}

}  // namespace test
}  // namespace hybridgv
