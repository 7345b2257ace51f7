#include "robust/Leverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "HybridScene.hpp"
#include "robust/LocalOptimizer.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kNoise = 0.5;
constexpr KindLoss kUnitNoise{Loss::Quadratic, 1, 1};

test::HybridScene makeScene(test::Random& random, int rays, int points) {
  test::SceneOptions options;
  options.rays = rays;
  options.points = points;
  options.imageNoise = kNoise;
  return test::makeHybridScene(random, options);
}

correspondences::CorrespondenceArrays readAll(const NoncentralHybridAdapter& adapter) {
  return {adapter, correspondences::allIndices(adapter.getNumberCorrespondences2d2d()),
          correspondences::allIndices(adapter.getNumberCorrespondences2d3d())};
}

test::HybridScene without(test::HybridScene scene, std::size_t ray) {
  const auto at = static_cast<std::ptrdiff_t>(ray);
  scene.image2d2d.erase(scene.image2d2d.begin() + at);
  scene.bearings.erase(scene.bearings.begin() + at);
  scene.cameras.erase(scene.cameras.begin() + at);
  return scene;
}

TEST(Leverage, OfRaysAloneSumsUpToTheNumberOfParameters) {
  test::Random random(test::testSeed(), 90);
  for (const int size : {8, 13, 60}) {
    const test::HybridScene scene = makeScene(random, size, 0);
    const correspondences::CorrespondenceArrays arrays = readAll(scene.adapter());
    const LeastSquaresProblem problem = makeProblem(arrays, kUnitNoise, kUnitNoise);
    const std::vector<double> leverages = rayLeverages(problem, arrays.normalization().apply(scene.truth));
    ASSERT_EQ(leverages.size(), static_cast<std::size_t>(size));
    EXPECT_NEAR(std::accumulate(leverages.begin(), leverages.end(), 0.), problem.estimated.parameters(), 1e-5);
    for (const double h : leverages) EXPECT_TRUE(h >= 0 && h <= 1 + 1e-6) << h;
  }
}

TEST(Leverage, TellsTheErrorOfARayAtTheMinimumWithoutIt) {
  test::Random random(test::testSeed(), 91);
  const test::HybridScene scene = makeScene(random, 20, 20);
  const correspondences::CorrespondenceArrays arrays = readAll(scene.adapter());
  const LeastSquaresProblem problem = makeProblem(arrays, kUnitNoise, kUnitNoise);
  const FocalPose minimum = minimize(problem, arrays.normalization().apply(scene.truth)).pose;
  const std::vector<double> leverages = rayLeverages(problem, minimum);
  const std::vector<double> errors = PoseScorer(arrays, {10, 10}, sac::Scoring::Msac).squaredRayErrors(minimum);
  const PoseScorer inWorld(arrays, {10, 10}, sac::Scoring::Msac);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const correspondences::CorrespondenceArrays rest = readAll(without(scene, i).adapter());
    const FocalPose start = rest.normalization().apply(arrays.normalization().undo(minimum));
    const FocalPose restMinimum = rest.normalization().undo(minimize(makeProblem(rest, kUnitNoise, kUnitNoise), start).pose);
    const double error = std::sqrt(inWorld.squaredRayErrors(arrays.normalization().apply(restMinimum))[i]);
    EXPECT_NEAR(error, std::sqrt(errors[i]) / (1 - leverages[i]), 0.02 * error + 0.01) << "leverage " << leverages[i];
  }
}

TEST(Leverage, IsZeroWhereTheDataDoNotFixThePose) {
  test::Random random(test::testSeed(), 92);
  const test::HybridScene scene = makeScene(random, 3, 0);
  const correspondences::CorrespondenceArrays arrays = readAll(scene.adapter());
  const LeastSquaresProblem problem = makeProblem(arrays, kUnitNoise, kUnitNoise);
  EXPECT_EQ(rayLeverages(problem, arrays.normalization().apply(scene.truth)), std::vector<double>(3, 0));
  EXPECT_EQ(narrowingByLeverage(rayLeverages(problem, arrays.normalization().apply(scene.truth))), std::vector<double>(3, 1));
}

TEST(Leverage, NarrowsTheLossOfNoRayWithoutEnd) {
  test::Random random(test::testSeed(), 93);
  const test::HybridScene scene = makeScene(random, 7, 0);  // every ray fixes a direction: leverage 1
  const correspondences::CorrespondenceArrays arrays = readAll(scene.adapter());
  const LeastSquaresProblem problem = makeProblem(arrays, kUnitNoise, kUnitNoise);
  const std::vector<double> narrowing = narrowingByLeverage(rayLeverages(problem, arrays.normalization().apply(scene.truth)));
  ASSERT_EQ(narrowing.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_TRUE(narrowing[i] >= 1 && narrowing[i] < 101) << narrowing[i];
}

// The pose with the conditional mean of all parameters, given that the focal length is wrong by some standard deviations.
FocalPose withWrongFocalLength(const correspondences::CorrespondenceArrays& arrays, const LeastSquaresProblem& problem,
                               const FocalPose& pose, double deviations) {
  ParameterMatrix covariance;
  EXPECT_TRUE(invertInformation(information(problem, pose), covariance));
  const Eigen::VectorXd step = deviations / std::sqrt(covariance(6, 6)) * covariance.col(6);
  FocalPose result = pose;
  const Eigen::Vector3d turn = step.head<3>();
  result.rotation = pose.rotation * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  result.position += step.segment<3>(3);
  result.focalLength *= std::exp(step[6]);
  return arrays.normalization().undo(result);
}

// A wrong match that a pose agrees with exactly: its rays meet close to the query.
test::HybridScene withLever(test::Random& random, const test::HybridScene& scene, const FocalPose& pose) {
  test::HybridScene result = scene;
  const Eigen::Vector3d image = test::randomImagePoint(random);
  const Eigen::Vector3d direction = pose.rotation * Eigen::Vector3d(image[0], image[1], pose.focalLength);
  const Eigen::Vector3d meeting = pose.position + 0.3 * direction.normalized();
  result.image2d2d.push_back(image);
  result.bearings.push_back((scene.rotations[0].transpose() * (meeting - scene.offsets[0])).normalized());
  result.cameras.push_back(0);
  return result;
}

// The wrong match has a large error where all others have their minimum, and none at a pose that is five standard deviations away.
TEST(Leverage, OfASingleWrongRaySeldomHoldsAPose) {
  test::Random random(test::testSeed(), 94);
  const KindLoss noise{Loss::Quadratic, kNoise, 1 / (kNoise * kNoise)};
  int tried = 0, held = 0, heldWithoutNarrowing = 0;
  while (tried < 50) {
    const test::HybridScene right = makeScene(random, 60, 60);
    const correspondences::CorrespondenceArrays rightArrays = readAll(right.adapter());
    const LeastSquaresProblem problem = makeProblem(rightArrays, noise, noise);
    const FocalPose minimum = minimize(problem, rightArrays.normalization().apply(right.truth)).pose;
    const FocalPose wrong = withWrongFocalLength(rightArrays, problem, minimum, 5);
    const test::HybridScene scene = withLever(random, right, wrong);

    correspondences::CorrespondenceArrays arrays = readAll(scene.adapter());
    arrays.fixUnknownFocalLengths();
    PoseScorer scorer(arrays, {6, 12}, sac::Scoring::Msac);
    scorer.setThresholds({2.5 * kNoise, 2.5 * kNoise});
    const ChanceModel chance(arrays, 6, 12);
    const QueryFeatures features(arrays);
    const LocalOptimizer optimizer(scorer, chance, features, 0, 1e9);
    const auto squaredError = [&](const FocalPose& pose) { return scorer.squaredRayErrors(pose).back(); };
    const double atMinimum = squaredError(arrays.normalization().apply(rightArrays.normalization().undo(minimum)));
    if (!(atMinimum > 100 * kNoise * kNoise) || std::isinf(atMinimum)) continue;
    ++tried;
    const FocalPose start = arrays.normalization().apply(wrong);
    held += squaredError(optimizer.polish(start).pose) < 9 * kNoise * kNoise;
    heldWithoutNarrowing += squaredError(optimizer.settle(start, kBothKinds)) < 9 * kNoise * kNoise;
  }
  EXPECT_LE(held, 25);
  EXPECT_GE(heldWithoutNarrowing, 40);  // else the problems show nothing
}

}  // namespace
}  // namespace hybridgv
