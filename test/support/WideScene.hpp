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
  double pointNoise = 0;  // standard deviation of the 3D points per coordinate, as a share of their distance
  double outlierShare = 0;
  QueryLens lens = simpleRadialLens(0);
  double meanDepth = 11, relief = 6;             // of the points: mean depth and largest deviation from it
  double leastFocal = 700, largestFocal = 1400;  // [px] of the query
  bool isBox = false;  // points in a box far away, most of which are seen near the image's centre, as in HybridScene
};

constexpr double kWideHalfSize = 500;

// A point and where it is seen.
struct SeenPoint {
  Eigen::Vector3d point, image;
};

inline SeenPoint makeSeenPoint(Random& random, const FocalPose& query, const WideSceneOptions& options) {
  for (;;) {
    const Eigen::Vector3d place = random.vector(-1, 1);
    const double depth = options.meanDepth + options.relief * place[2], width = 1.1 * kWideHalfSize / query.focalLength * depth;
    const Eigen::Vector3d inQuery =
        options.isBox ? toCamera(query, 5 * place) : Eigen::Vector3d(width * place[0], width * place[1], depth);
    const Eigen::Vector2d exact = options.lens(inQuery.hnormalized(), query.focalLength);
    if (exact.cwiseAbs().maxCoeff() <= kWideHalfSize)
      return {query.position + query.rotation * inQuery, noisyImagePoint(random, exact, options.imageNoise)};
  }
}

inline void addRays(Random& random, const WideSceneOptions& options, HybridScene& scene) {
  for (int i = 0; i < options.rays; ++i) {
    const int k = i % options.cameras;
    FocalPose camera;
    camera.rotation = scene.rotations[static_cast<std::size_t>(k)];
    camera.position = scene.offsets[static_cast<std::size_t>(k)];
    camera.focalLength = kRigFocalLength;
    SeenPoint seen = makeSeenPoint(random, scene.truth, options);
    while (toCamera(camera, seen.point)[2] < 1) seen = makeSeenPoint(random, scene.truth, options);
    const bool inlier = i >= std::lround(options.outlierShare * options.rays);
    const Eigen::Vector3d inMap = noisyImagePoint(random, project(camera, seen.point), options.imageNoise);
    scene.image2d2d.push_back(inlier ? seen.image : randomImagePoint(random));
    scene.bearings.push_back(Eigen::Vector3d(inMap[0], inMap[1], kRigFocalLength).normalized());
    scene.cameras.push_back(k);
    scene.inliers2d2d.push_back(inlier);
  }
}

inline void addPoints(Random& random, const WideSceneOptions& options, HybridScene& scene) {
  for (int i = 0; i < options.points; ++i) {
    const SeenPoint seen = makeSeenPoint(random, scene.truth, options);
    const bool inlier = i >= std::lround(options.outlierShare * options.points);
    const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
    const double deviation = options.pointNoise * (seen.point - scene.truth.position).norm();
    scene.image2d3d.push_back(inlier ? seen.image : randomImagePoint(random));
    scene.points.push_back(seen.point + deviation * error);
    scene.inliers2d3d.push_back(inlier);
  }
}

// The image is 1000 px wide. The focal length is 700 to 1400 px, with a box 500 to 2000 px.
inline HybridScene makeWideScene(Random& random, const WideSceneOptions& options) {
  HybridScene scene;
  const auto look = [&](double focalLength) {
    return cameraLookingAtOrigin(random, options.isBox ? random.uniform(15, 25) : random.uniform(10, 18), focalLength);
  };
  const double focalLength = options.isBox ? random.uniform(500, 2000) : random.uniform(options.leastFocal, options.largestFocal);
  scene.truth = look(focalLength);
  for (int k = 0; k < options.cameras; ++k) {
    const FocalPose camera = look(kRigFocalLength);
    scene.offsets.push_back(camera.position);
    scene.rotations.push_back(camera.rotation);
  }
  addRays(random, options, scene);
  addPoints(random, options, scene);
  return scene;
}

}  // namespace test
}  // namespace hybridgv
