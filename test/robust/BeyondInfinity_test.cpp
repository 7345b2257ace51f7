// Rays that meet their viewing rays behind both cameras.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "HybridScene.hpp"
#include "SimdLevels.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "hybridgv/distortion.hpp"
#include "movedPose.hpp"
#include "robust/kernels/Kernels.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kRigFocalLength = 800;

struct Model {
  CameraModel model;
  double distortion;
  int parameters;
};
constexpr Model kModels[] = {{CameraModel::Pinhole, 0, 7},
                             {CameraModel::CalibratedPinhole, 0, 6},
                             {CameraModel::Radial, 0, 8},
                             {CameraModel::Radial, -2e-7, 8},
                             {CameraModel::Radial, 1e-7, 8}};

// Rays of rig cameras that are seen at chosen distances from the images of their points at infinity: along the epipolar line, positive
// beyond infinity, and across it [px], both in a pinhole image.
struct Scene {
  Scene(test::Random& random, const Model& model, const std::vector<Eigen::Vector2d>& distances,
        bool mapFocalLengthsAreKnown = true)
      : pose(test::cameraLookingAtOrigin(random, 20, 1000)) {
    pose.distortion = model.distortion;
    for (const Eigen::Vector2d& distance : distances) addRay(random, distance);
    NoncentralHybridAdapter adapter = scene.adapter();
    std::vector<double> focalLengths(distances.size(), kRigFocalLength);
    if (!mapFocalLengthsAreKnown) std::fill(focalLengths.begin(), focalLengths.end(), 0);
    adapter.setRigFocalLengths(focalLengths);
    arrays.emplace(adapter, correspondences::allIndices(distances.size()), std::vector<int>());
    pose.position = arrays->normalization().apply(pose.position);
  }
  void addRay(test::Random& random, const Eigen::Vector2d& distance) {
    const double x = random.uniform(-0.3, 0.3), y = random.uniform(-0.3, 0.3);
    const Eigen::Vector3d direction = Eigen::Vector3d(x, y, 1), offset = 3 * random.direction();
    // The point at the depth z is seen at q + b / z.
    const Eigen::Vector2d q = 1000 * Eigen::Vector2d(x, y), b = offset.head<2>() - offset.z() * Eigen::Vector2d(x, y);
    const Eigen::Vector2d along = -b.normalized(), across(-along.y(), along.x());
    const Eigen::Vector2d pinhole = q + distance.x() * along + distance.y() * across;
    scene.image2d2d.push_back(*distort(pose.distortion, pinhole.homogeneous()));
    scene.bearings.push_back(direction.normalized());
    scene.offsets.push_back(pose.position + pose.rotation * offset);
    scene.rotations.push_back(pose.rotation);
    scene.cameras.push_back(static_cast<int>(scene.cameras.size()));
  }
  std::vector<double> errors(const Kernels& tested) const {
    std::vector<double> result(correspondences::padded(scene.bearings.size()));
    tested.squaredRayErrorsBeyondInfinity(arrays->rayArrays(), toPlain(pose), result.data());
    result.resize(scene.bearings.size());
    return result;
  }
  NormalEquations sums(const Kernels& tested, const QueryPose& at, const KindLoss& loss) const {
    NormalEquations result;
    tested.addRays(arrays->rayArrays(), toPlain(at), loss, result);
    return result;
  }

  QueryPose pose;
  test::HybridScene scene;
  std::optional<correspondences::CorrespondenceArrays> arrays;
};

template <class Body>
void forAllKernels(Body body) {
  for (const math::SimdLevel level : test::supportedLevels())
    for (const Model& model : kModels) body(kernels(level, model.model), model);
}

TEST(BeyondInfinity, TheErrorIsTheDistanceFromThePlaceAtInfinity) {
  forAllKernels([](const Kernels& tested, const Model& model) {
    test::Random random(test::testSeed(), 190);
    std::vector<Eigen::Vector2d> distances;
    for (int i = 0; i < 21; ++i) distances.push_back({random.uniform(0.1, 20), 0});
    const Scene scene(random, model, distances);
    const std::vector<double> errors = scene.errors(tested);
    for (std::size_t i = 0; i < distances.size(); ++i) {
      // The rig cameras are turned as the query: what moves by a pixel in their images is moved by that many here.
      constexpr double kPixels = 1000 / kRigFocalLength;
      const double expected = std::pow(distances[i].x(), 2) / (1 + kPixels * kPixels);
      EXPECT_NEAR(errors[i], expected, 1e-6 * expected);
    }
  });
}

TEST(BeyondInfinity, TheErrorIsContinuousAtInfinity) {
  forAllKernels([](const Kernels& tested, const Model& model) {
    for (int i = 0; i < 20; ++i) {
      test::Random random(test::testSeed() + static_cast<std::uint64_t>(i), 191),
          same(test::testSeed() + static_cast<std::uint64_t>(i), 191);
      const double before = Scene(random, model, {{-1e-5, 0.8}}).errors(tested)[0];
      const double beyond = Scene(same, model, {{1e-5, 0.8}}).errors(tested)[0];
      EXPECT_GT(before, 0);
      EXPECT_NEAR(beyond, before, 1e-4);
    }
  });
}

// Without an error across the line, the derivatives are exact.
TEST(BeyondInfinity, GradientsAreTheCentralDifferencesOfTheCost) {
  forAllKernels([](const Kernels& tested, const Model& model) {
    test::Random random(test::testSeed(), 192);
    std::vector<Eigen::Vector2d> distances;
    for (int i = 0; i < 21; ++i) distances.push_back({random.uniform(0.5, 8), 0});
    for (const bool known : {true, false}) {
      const Scene scene(random, model, distances, known);
      for (const Loss kind : {Loss::Truncated, Loss::Mixture}) {
        const KindLoss loss{kind, 15, 2, 50, true};
        const NormalEquations here = scene.sums(tested, scene.pose, loss);
        EXPECT_GT(here.cost, 0);
        constexpr double h = 1e-6;
        for (int i = 0; i < model.parameters; ++i) {
          const double difference = (scene.sums(tested, test::moved(scene.pose, i, h), loss).cost -
                                     scene.sums(tested, test::moved(scene.pose, i, -h), loss).cost) /
                                    (2 * h);
          EXPECT_NEAR(2 * test::unitOf(i) * here.gradient[i], difference, 1e-4 * (1 + std::abs(difference))) << "parameter " << i;
        }
      }
    }
  });
}

TEST(BeyondInfinity, OnlyLossesThatReachThereCountIt) {
  forAllKernels([](const Kernels& tested, const Model& model) {
    test::Random random(test::testSeed(), 193);
    const Scene scene(random, model, std::vector<Eigen::Vector2d>(9, {2, 0.5}));
    KindLoss loss{Loss::Mixture, 4, 1, 100};
    const NormalEquations without = scene.sums(tested, scene.pose, loss);
    EXPECT_EQ(without.hessian[0][0], 0);
    loss.reachesBeyondInfinity = true;
    const NormalEquations with = scene.sums(tested, scene.pose, loss);
    EXPECT_GT(with.hessian[0][0], 0);
    EXPECT_LT(with.cost, 0.7 * without.cost);
    std::vector<double> errors(16);
    tested.squaredRayErrors(scene.arrays->rayArrays(), toPlain(scene.pose), errors.data());
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(errors[i], kInfinity);
  });
}

// Before infinity nothing is another.
TEST(BeyondInfinity, RaysThatMeetInFrontAreAsBefore) {
  forAllKernels([](const Kernels& tested, const Model& model) {
    test::Random random(test::testSeed(), 194);
    std::vector<Eigen::Vector2d> distances;
    for (int i = 0; i < 21; ++i) distances.push_back({random.uniform(-30, -5), random.uniform(-2, 2)});
    const Scene scene(random, model, distances);
    KindLoss loss{Loss::Mixture, 4, 1, 100};
    const NormalEquations without = scene.sums(tested, scene.pose, loss);
    loss.reachesBeyondInfinity = true;
    const NormalEquations with = scene.sums(tested, scene.pose, loss);
    EXPECT_EQ(with.cost, without.cost);
    for (int i = 0; i < model.parameters; ++i) EXPECT_EQ(with.gradient[i], without.gradient[i]);
  });
}

// What is at infinity behind the query is not in its image.
TEST(BeyondInfinity, ADirectionBehindTheQueryHasTheErrorThatItHasAnyway) {
  forAllKernels([](const Kernels& tested, const Model& model) {
    test::Random random(test::testSeed(), 195);
    Scene scene(random, model, std::vector<Eigen::Vector2d>(9, {2, 0.5}));
    scene.pose.rotation = scene.pose.rotation * Eigen::AngleAxisd(3.1415926535897932, Eigen::Vector3d::UnitX());
    std::vector<double> expected(16);
    tested.squaredRayErrors(scene.arrays->rayArrays(), toPlain(scene.pose), expected.data());
    const std::vector<double> errors = scene.errors(tested);
    for (std::size_t i = 0; i < errors.size(); ++i) EXPECT_EQ(errors[i], expected[i]);
    EXPECT_GT(std::count(errors.begin(), errors.end(), kInfinity), 0);
  });
}

TEST(BeyondInfinity, APoseThatIsNotANumberHasInfiniteErrors) {
  forAllKernels([](const Kernels& tested, const Model& model) {
    test::Random random(test::testSeed(), 196);
    Scene scene(random, model, std::vector<Eigen::Vector2d>(9, {2, 0.5}));
    scene.pose.position[1] = NAN;
    for (const double error : scene.errors(tested)) EXPECT_EQ(error, kInfinity);
    const NormalEquations sums = scene.sums(tested, scene.pose, {Loss::Mixture, 4, 1, 100, true});
    EXPECT_EQ(sums.hessian[0][0], 0);
  });
}

}  // namespace
}  // namespace hybridgv
