// Image points that crowd in one place, and wrong matches with the image points of other features: from far away, many poses see much of the map
// there.
#include <gtest/gtest.h>

#include <cmath>

#include "EqualResults.hpp"
#include "HybridScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac::hybridRansac;
using sac::HybridRansacOptions;
using sac::HybridRansacResult;

// A coordinate that crowds in the middle: half of them are within a sixteenth of `most`.
double crowded(Random& random, double most) {
  const double u = random.uniform(-1, 1);
  return std::copysign(most * u * u * u * u, u);
}

Eigen::Vector3d crowdedPosition(Random& random, const FocalPose& query) {
  const double depth = random.uniform(15, 25);
  const Eigen::Vector2d image(crowded(random, 400), crowded(random, 300));
  const Eigen::Vector2d inQuery = depth / query.focalLength * image;
  return query.position + query.rotation * Eigen::Vector3d(inQuery.x(), inQuery.y(), depth);
}

// The first ones get others' image points.
void spoil(Random& random, double share, std::vector<Eigen::Vector3d>& imagePoints) {
  const std::vector<Eigen::Vector3d> right = imagePoints;
  const int wrong = static_cast<int>(share * static_cast<double>(right.size()));
  for (int i = 0; i < wrong; ++i)
    imagePoints[static_cast<std::size_t>(i)] = right[static_cast<std::size_t>((i + 1 + random.below(wrong - 1)) % wrong)];
}

HybridScene crowdedScene(std::uint64_t stream, int ofEachKind, double wrong) {
  Random random(testSeed() + stream, 77);
  SceneOptions options;
  options.rays = options.points = ofEachKind;
  HybridScene scene = makeHybridScene(random, options);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    scene.points[i] = crowdedPosition(random, scene.truth);
    scene.image2d3d[i] = noisyImagePoint(random, project(scene.truth, scene.points[i]), 1);
    const Eigen::Vector3d position = crowdedPosition(random, scene.truth);
    const auto camera = static_cast<std::size_t>(scene.cameras[i]);
    scene.bearings[i] = (scene.rotations[camera].transpose() * (position - scene.offsets[camera])).normalized();
    scene.image2d2d[i] = noisyImagePoint(random, project(scene.truth, position), 1);
  }
  spoil(random, wrong, scene.image2d2d);
  spoil(random, wrong, scene.image2d3d);
  return scene;
}

TEST(Crowding, DoesNotHideTheRightPose) {
  int successes = 0, right = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const HybridScene scene = crowdedScene(i, 200, 0.85);
    HybridRansacOptions options;
    options.seed = i;
    const HybridRansacResult result = hybridRansac(scene.adapter(), options);
    successes += result.success;
    right += result.success && std::abs(std::log(result.pose.focalLength / scene.truth.focalLength)) < 0.1;
  }
  EXPECT_GE(successes, 38);
  EXPECT_EQ(right, successes);
}

TEST(Crowding, ResultsAreTheSameForAnyNumberOfThreads) {
  for (std::uint64_t i = 0; i < 5; ++i)
    for (const bool isKnown : {false, true}) {
      const HybridScene scene = crowdedScene(i, 100, 0.85);
      HybridRansacOptions options;
      options.seed = i;
      if (isKnown) options.knownFocalLengthPx = scene.truth.focalLength;
      const HybridRansacResult one = hybridRansac(scene.adapter(), options);
      for (const int threads : {2, 5}) {
        options.threads = threads;
        expectEqual(one, hybridRansac(scene.adapter(), options));
      }
    }
}

TEST(Crowding, RightPosesAreFoundByInlierCountsAndFromAnInitialPoseToo) {
  int byCount = 0, fromInitialPose = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const HybridScene scene = crowdedScene(i, 200, 0.8);
    HybridRansacOptions options;
    options.seed = i;
    options.scoring = sac::Scoring::InlierCount;
    byCount += hybridRansac(scene.adapter(), options).success;
    options.scoring = sac::Scoring::Msac;
    options.initialPose = scene.truth;
    fromInitialPose += hybridRansac(scene.adapter(), options).success;
  }
  EXPECT_GE(byCount, 19);
  EXPECT_EQ(fromInitialPose, 20);
}

// Rays of one camera, and points of a small thing that are all wrong: at some distance the thing is as small as the place where their image
// points crowd.
HybridScene sceneWithoutScale(std::uint64_t stream) {
  Random random(testSeed() + stream, 78);
  SceneOptions options;
  options.rays = 60 + random.below(100);
  options.points = 20 + random.below(100);
  options.cameras = 1;
  options.imageNoise = 1;
  HybridScene scene = makeHybridScene(random, options);
  const Eigen::Vector3d place(random.uniform(-200, 200), random.uniform(-200, 200), 1), thing = random.vector(-3, 3);
  const double size = random.uniform(0.2, 1.5), crowd = 15;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    scene.image2d3d[i] = place + Eigen::Vector3d(crowd * random.normal(), crowd * random.normal(), 0);
    scene.points[i] = thing + size * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  return scene;
}

TEST(Crowding, WrongPointsDoNotFixTheScale) {
  int successes = 0;
  for (std::uint64_t i = 0; i < 100; ++i)
    for (const bool isKnown : {false, true}) {
      const HybridScene scene = sceneWithoutScale(i);
      HybridRansacOptions options;
      options.seed = i;
      if (isKnown) options.knownFocalLengthPx = scene.truth.focalLength;
      successes += hybridRansac(scene.adapter(), options).success;
    }
  EXPECT_LE(successes, 1) << "of 200";
}

// Nothing is right: image points of each kind in any order.
TEST(Crowding, OfWrongMatchesOnlyIsNoSuccess) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const HybridScene scene = crowdedScene(i, 60, 1);
    HybridRansacOptions options;
    options.seed = i;
    EXPECT_FALSE(hybridRansac(scene.adapter(), options).success) << "scene " << i;
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv
