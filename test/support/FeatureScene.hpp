// Scenes in which the query's features have several correspondences each.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "HybridScene.hpp"

namespace hybridgv {
namespace test {

// A scene without noise in which every feature of the query has so many rays, of different rig cameras, and a point, if wanted.
inline HybridScene makeFeatureScene(Random& random, int features, int raysPerFeature, bool withPoints) {
  SceneOptions options;
  options.rays = options.points = 0;
  HybridScene scene = makeHybridScene(random, options);
  const auto cameraAt = [&](int k) {
    const auto camera = static_cast<std::size_t>(k) % scene.offsets.size();
    return FocalPose{scene.rotations[camera], scene.offsets[camera], kRigFocalLength};
  };
  for (int i = 0; i < features; ++i) {
    Eigen::Vector3d point;
    bool isSeen = false;
    while (!isSeen) {
      point = random.vector(-5, 5);
      isSeen = isVisible(scene.truth, point);
      for (int k = 0; k < raysPerFeature; ++k) isSeen = isSeen && isVisible(cameraAt(i + k), point);
    }
    const Eigen::Vector2d image = project(scene.truth, point);
    for (int k = 0; k < raysPerFeature; ++k) {
      scene.image2d2d.emplace_back(image[0], image[1], 1);
      const Eigen::Vector2d inMap = project(cameraAt(i + k), point);
      scene.bearings.emplace_back(inMap[0], inMap[1], kRigFocalLength);
      scene.cameras.push_back((i + k) % options.cameras);
    }
    if (!withPoints) continue;
    scene.image2d3d.emplace_back(image[0], image[1], 1);
    scene.points.push_back(point);
  }
  return scene;
}

// Noise of the features and of the map images [px per coordinate].
inline HybridScene withFeatureNoise(Random& random, HybridScene scene, double noise, double mapNoise) {
  std::map<std::pair<double, double>, Eigen::Vector3d> errors;
  for (auto* images : {&scene.image2d2d, &scene.image2d3d})
    for (Eigen::Vector3d& image : *images) {
      const Eigen::Vector3d error(noise * random.normal(), noise * random.normal(), 0);
      image += errors.emplace(std::pair(image[0], image[1]), error).first->second;
    }
  for (Eigen::Vector3d& bearing : scene.bearings)
    bearing += Eigen::Vector3d(mapNoise * random.normal(), mapNoise * random.normal(), 0);
  return scene;
}
inline HybridScene withFeatureNoise(Random& random, const HybridScene& scene, double noise) {
  return withFeatureNoise(random, scene, noise, noise);
}

// All correspondences so many times.
inline HybridScene repeated(const HybridScene& scene, int times) {
  HybridScene result = scene;
  const auto append = [](const auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  for (int i = 1; i < times; ++i) {
    append(scene.image2d2d, result.image2d2d);
    append(scene.bearings, result.bearings);
    append(scene.cameras, result.cameras);
    append(scene.image2d3d, result.image2d3d);
    append(scene.points, result.points);
  }
  return result;
}

// With the rig cameras' focal lengths.
inline NoncentralHybridAdapter adapterOf(const HybridScene& scene) {
  NoncentralHybridAdapter adapter = scene.adapter();
  adapter.setRigFocalLengths(std::vector<double>(scene.offsets.size(), kRigFocalLength));
  return adapter;
}

}  // namespace test
}  // namespace hybridgv
