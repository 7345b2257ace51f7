#include "hybridgv/sac_problems/hybrid_pose/HybridPoseSacProblem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "FocalPoseNear.hpp"
#include "SolverConfigurations.hpp"
#include "damage.hpp"
#include "expectRefused.hpp"
#include "hybridgv/distortion.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"
#include "hybridgv/sac_problems/hybrid_pose/MultiHybridPoseSacProblem.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {
namespace {

constexpr double kReprojectionPx = 4, kEpipolarPx = 2;

class SacProblem : public testing::Test {
 protected:
  SacProblem() : data_(test::makeMinimalProblem(random_, {8, 8, 8}, 20)), adapter_(test::makeAdapter(data_)) {}

  HybridPoseSacProblem flat(Solver solver, std::uint64_t seed = 0) const {
    return {adapter_, solver, kReprojectionPx, kEpipolarPx, seed, test::focalLengthFor(solver, data_.truth.focalLength)};
  }
  MultiHybridPoseSacProblem multi(Solver solver, std::uint64_t seed = 0) const {
    return {adapter_, solver, kReprojectionPx, kEpipolarPx, seed, test::focalLengthFor(solver, data_.truth.focalLength)};
  }

  test::Random random_{test::testSeed()};
  test::MinimalProblem data_;  // 24 rays, 20 points
  NoncentralHybridAdapter adapter_;
};

TEST_F(SacProblem, SampleHasTheMixtureOfTheSolver) {
  int unused = 0;
  for (Solver solver : allSolvers()) {
    HybridPoseSacProblem flatProblem = flat(solver);
    MultiHybridPoseSacProblem multiProblem = multi(solver);
    const std::vector<int> sizes = multiProblem.getSampleSizes();
    EXPECT_EQ(flatProblem.getSampleSize(), sizes[0] + sizes[1]);
    std::set<int> drawn;
    for (int i = 0; i < 1000; ++i) {
      std::vector<int> flatSample;
      flatProblem.getSamples(unused, flatSample);
      EXPECT_EQ(std::count_if(flatSample.begin(), flatSample.end(), [](int j) { return j < 24; }), sizes[0]);
      EXPECT_EQ(std::set<int>(flatSample.begin(), flatSample.end()).size(), flatSample.size());
      drawn.insert(flatSample.begin(), flatSample.end());
      std::vector<std::vector<int>> multiSample;
      multiProblem.getSamples(unused, multiSample);
      ASSERT_EQ(multiSample.size(), 2u);
      EXPECT_EQ(static_cast<int>(multiSample[0].size()), sizes[0]);
      EXPECT_EQ(static_cast<int>(multiSample[1].size()), sizes[1]);
    }
    // Every correspondence has its turn.
    EXPECT_EQ(drawn.size(), (sizes[0] > 0 ? 24u : 0u) + (sizes[1] > 0 ? 20u : 0u)) << toString(solver);
  }
}

TEST_F(SacProblem, FlatIndicesAreTheRaysThenThePoints) {
  constexpr double kRigFocalLength = 1200;
  adapter_.setRigFocalLengths({kRigFocalLength, kRigFocalLength, kRigFocalLength});
  const HybridPoseSacProblem problem = flat(Solver::H13f);
  const MultiHybridPoseSacProblem multiProblem = multi(Solver::H13f);
  FocalPose pose = data_.truth;
  pose.position += Eigen::Vector3d(0.1, 0.2, 0.3);
  std::vector<double> distances;
  problem.getSelectedDistancesToModel(pose, {43, 0, 24, 23}, distances);
  std::vector<std::vector<double>> byType;
  multiProblem.getSelectedDistancesToModel(pose, {{0, 23}, {0, 19}}, byType);
  const auto sampson = [&](std::size_t i) {
    return hybridgv::hybrid_pose::sampsonError(pose, adapter_.getImagePoint2d2d(i), adapter_.getBearingVector(i),
                                               adapter_.getCamOffset(i), adapter_.getCamRotation(i), kRigFocalLength) /
           kEpipolarPx;
  };
  const auto reprojection = [&](std::size_t i) {
    return hybridgv::hybrid_pose::reprojectionError(pose, adapter_.getImagePoint2d3d(i), adapter_.getPoint(i)) / kReprojectionPx;
  };
  const std::vector<double> expected{reprojection(19), sampson(0), reprojection(0), sampson(23)};
  ASSERT_EQ(distances.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(expected[i], 0.01);
    EXPECT_NEAR(distances[i], expected[i], 1e-9 * expected[i]);
  }
  const std::vector<double> expected2d2d{expected[1], expected[3]}, expected2d3d{expected[2], expected[0]};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(byType[0][i], expected2d2d[i], 1e-9 * expected2d2d[i]);
    EXPECT_NEAR(byType[1][i], expected2d3d[i], 1e-9 * expected2d3d[i]);
  }
}

// The Sampson error of any rays would vanish with the focal length, if an unknown one of the rig camera were taken to be the same.
TEST_F(SacProblem, RaysDoNotFitAVanishingFocalLength) {
  FocalPose collapsed = data_.truth;
  collapsed.focalLength *= 1e-4;
  int inliers = 0;
  for (int trial = 0; trial < 20; ++trial) {
    collapsed.rotation = random_.rotation();
    std::vector<double> distances;
    flat(Solver::H13f).getDistancesToModel(collapsed, distances);
    inliers += static_cast<int>(std::count_if(distances.begin(), distances.begin() + 24, [](double d) { return d < 1; }));
  }
  EXPECT_LT(inliers, 20 * 24 / 20);
}

TEST_F(SacProblem, DistancesAreFinite) {
  FocalPose behind = data_.truth;  // looks away from the scene
  behind.rotation.col(0) *= -1;
  behind.rotation.col(2) *= -1;
  FocalPose broken;
  broken.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  HybridPoseSacProblem problem = flat(Solver::H13f);
  for (const FocalPose& pose : {behind, broken}) {
    std::vector<double> distances;
    problem.getDistancesToModel(pose, distances);
    ASSERT_EQ(distances.size(), 44u);
    for (double distance : distances) EXPECT_TRUE(distance >= 0 && distance <= HybridProblemCore::kMaxDistance);
    for (std::size_t i = 24; i < 44; ++i) EXPECT_EQ(distances[i], HybridProblemCore::kMaxDistance);
  }
  EXPECT_EQ(problem.countWithinDistance(broken, 1.0), 0);
}

TEST_F(SacProblem, InliersAreTheDistancesBelowTheThreshold) {
  test::addNoise(random_, 3, data_);
  const NoncentralHybridAdapter adapter = test::makeAdapter(data_);
  HybridPoseSacProblem problem(adapter, Solver::H13f, kReprojectionPx, kEpipolarPx);
  MultiHybridPoseSacProblem multiProblem(adapter, Solver::H13f, kReprojectionPx, kEpipolarPx);
  std::vector<double> distances;
  problem.getDistancesToModel(data_.truth, distances);
  const auto below = std::count_if(distances.begin(), distances.end(), [](double d) { return d < 1; });
  EXPECT_GT(below, 5);
  EXPECT_LT(below, 44);
  std::vector<int> inliers;
  problem.selectWithinDistance(data_.truth, 1.0, inliers);
  std::vector<std::vector<int>> multiInliers;
  multiProblem.selectWithinDistance(data_.truth, 1.0, multiInliers);
  EXPECT_EQ(problem.countWithinDistance(data_.truth, 1.0), below);
  EXPECT_EQ(multiProblem.countWithinDistance(data_.truth, 1.0), below);
  EXPECT_EQ(static_cast<std::ptrdiff_t>(inliers.size()), below);
  EXPECT_EQ(static_cast<std::ptrdiff_t>(multiInliers[0].size() + multiInliers[1].size()), below);
}

// The published first number of splitmix64 with seed 0 is 0xe220a8397b1dcdaf.
TEST_F(SacProblem, RandomNumbersAreTheSameOnEveryPlatform) {
  EXPECT_EQ(flat(Solver::P4Pf, 0).rnd(), static_cast<int>(0xe220a8397b1dcdafULL >> 33));
  EXPECT_EQ(multi(Solver::P4Pf, 0).rnd(), static_cast<int>(0xe220a8397b1dcdafULL >> 33));
}

TEST_F(SacProblem, SamplesFollowTheSeed) {
  const auto draw = [this](std::uint64_t seed) {
    HybridPoseSacProblem problem = flat(Solver::H13f, seed);
    std::vector<std::vector<int>> samples(20);
    int unused = 0;
    for (std::vector<int>& sample : samples) problem.getSamples(unused, sample);
    return samples;
  };
  EXPECT_EQ(draw(5), draw(5));
  EXPECT_NE(draw(5), draw(6));
  EXPECT_NE(draw(5), draw(5 + (std::uint64_t{1} << 40)));
}

TEST_F(SacProblem, SamplesComeFromTheIndicesThatWereSet) {
  int unused = 0;
  HybridPoseSacProblem problem = flat(Solver::H13f);
  problem.setIndices({40, 3, 30, 25, 7});
  MultiHybridPoseSacProblem multiProblem = multi(Solver::H13f);
  multiProblem.setIndices({{3, 7}, {16, 6, 1}});
  for (int i = 0; i < 100; ++i) {
    std::vector<int> sample;
    problem.getSamples(unused, sample);
    std::sort(sample.begin(), sample.end());
    EXPECT_TRUE(sample == (std::vector<int>{3, 25, 30, 40}) || sample == (std::vector<int>{7, 25, 30, 40}));
    std::vector<std::vector<int>> multiSample;
    multiProblem.getSamples(unused, multiSample);
    EXPECT_TRUE(multiSample[0] == std::vector<int>{3} || multiSample[0] == std::vector<int>{7});
    std::sort(multiSample[1].begin(), multiSample[1].end());
    EXPECT_EQ(multiSample[1], (std::vector<int>{1, 6, 16}));
  }
}

// OpenGV hands out the list itself: a user may write into it.
TEST_F(SacProblem, ChangesOfTheListInPlaceAreNoticed) {
  int unused = 0;
  HybridPoseSacProblem problem = flat(Solver::H13f);
  MultiHybridPoseSacProblem multiProblem = multi(Solver::H13f);
  const auto expectDrawnFrom = [&](const std::set<int>& rays, const std::set<int>& points) {
    for (int i = 0; i < 200; ++i) {
      std::vector<int> sample;
      problem.getSamples(unused, sample);
      std::vector<std::vector<int>> multiSample;
      multiProblem.getSamples(unused, multiSample);
      for (const int index : sample) EXPECT_TRUE(index < 24 ? rays.count(index) : points.count(index - 24)) << index;
      for (const int ray : multiSample[0]) EXPECT_TRUE(rays.count(ray)) << ray;
      for (const int point : multiSample[1]) EXPECT_TRUE(points.count(point)) << point;
    }
    const int count = static_cast<int>(rays.size() + points.size());
    EXPECT_EQ(problem.countWithinDistance(data_.truth, 1.0), count);
    EXPECT_EQ(multiProblem.countWithinDistance(data_.truth, 1.0), count);
  };
  problem.setIndices({0, 1, 24, 25, 26, 27, 28});
  multiProblem.setIndices({{0, 1}, {0, 1, 2, 3, 4}});
  expectDrawnFrom({0, 1}, {0, 1, 2, 3, 4});
  // Entries written over, one kind by the other.
  for (int& index : *problem.getIndices())
    if (index == 24) index = 7;
  (*multiProblem.getIndices())[0] = {0, 1, 7};
  (*multiProblem.getIndices())[1] = {1, 2, 3, 4};
  expectDrawnFrom({0, 1, 7}, {1, 2, 3, 4});
  // One appended, one removed.
  problem.getIndices()->push_back(40);
  problem.getIndices()->erase(problem.getIndices()->begin());
  (*multiProblem.getIndices())[0].erase((*multiProblem.getIndices())[0].begin());
  (*multiProblem.getIndices())[1].push_back(16);
  expectDrawnFrom({1, 7}, {1, 2, 3, 4, 16});
}

// The pool's own arrays are a part of all: the same errors.
TEST_F(SacProblem, APartOfTheCorrespondencesIsCountedAsInTheWhole) {
  test::addNoise(random_, 3, data_);
  const NoncentralHybridAdapter adapter = test::makeAdapter(data_);
  HybridPoseSacProblem problem(adapter, Solver::H13f, kReprojectionPx, kEpipolarPx);
  std::vector<double> all, part;
  problem.getDistancesToModel(data_.truth, all);
  const std::vector<int> list{43, 5, 24, 24, 0, 30, 5, 23};
  problem.setIndices(list);
  problem.getDistancesToModel(data_.truth, part);
  int inliers = 0;
  ASSERT_EQ(part.size(), list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(part[i], all[static_cast<std::size_t>(list[i])]);
    inliers += part[i] < 1;
  }
  EXPECT_EQ(problem.countWithinDistance(data_.truth, 1.0), inliers);
}

TEST_F(SacProblem, TooFewIndicesGiveAnEmptySample) {
  int iterations = 0;
  HybridPoseSacProblem problem = flat(Solver::H13f);
  problem.setIndices({0, 1, 2, 3, 30, 31});  // two points, one missing
  std::vector<int> sample{1, 2, 3};
  problem.getSamples(iterations, sample);
  EXPECT_TRUE(sample.empty());
  EXPECT_EQ(iterations, 0);
  MultiHybridPoseSacProblem multiProblem = multi(Solver::H13f);
  multiProblem.setIndices({{}, {1, 2, 3}});
  std::vector<std::vector<int>> multiSample{{1}, {2}};
  multiProblem.getSamples(iterations, multiSample);
  EXPECT_TRUE(multiSample.empty());
}

TEST_F(SacProblem, RaysComeFromOneCameraWhereThatIsFasterUnlessToldOtherwise) {
  int unused = 0;
  const auto spread = [&](HybridPoseSacProblem& problem) {
    std::size_t most = 0;
    for (int i = 0; i < 100; ++i) {
      std::vector<int> sample;
      problem.getSamples(unused, sample);
      std::set<int> cameras;
      for (int j : sample)
        if (j < 24) cameras.insert(adapter_.getCamIndex(static_cast<std::size_t>(j)));
      most = std::max(most, cameras.size());
    }
    return most;
  };
  for (const auto& [solver, cameras] : {std::pair<Solver, std::size_t>(Solver::H51f, 1), {Solver::H70f, 2}}) {
    HybridPoseSacProblem problem = flat(solver);
    EXPECT_EQ(spread(problem), cameras);
    problem.setRaysFromOneCamera(false);
    EXPECT_EQ(spread(problem), 3u);
  }
}

TEST_F(SacProblem, DegenerateSamplesAreDrawnAgain) {
  // Points 0..9 on a line: of the 1140 triples of points 120 are collinear, so that a sample is good with probability 0.895.
  for (std::size_t i = 2; i < 10; ++i)
    data_.points[i].point =
        data_.points[0].point + 0.13 * static_cast<double>(i) * (data_.points[1].point - data_.points[0].point);
  const NoncentralHybridAdapter adapter = test::makeAdapter(data_);
  HybridPoseSacProblem problem(adapter, Solver::H13f, kReprojectionPx, kEpipolarPx);
  EXPECT_FALSE(problem.isSampleGood({0, 24, 27, 29}));
  EXPECT_TRUE(problem.isSampleGood({0, 24, 27, 40}));
  EXPECT_FALSE(problem.isSampleGood({0, 24, 40, 40}));
  int unused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<int> sample;
    problem.getSamples(unused, sample);
    EXPECT_TRUE(problem.isSampleGood(sample));
  }
}

TEST_F(SacProblem, KnownFocalLengthIsKept) {
  test::addNoise(random_, 1, data_);
  adapter_ = test::makeAdapter(data_);
  HybridPoseSacProblem problem = flat(Solver::P3P);
  int unused = 0;
  std::vector<int> sample, all;
  problem.getSamples(unused, sample);
  FocalPose model, refined;
  ASSERT_TRUE(problem.computeModelCoefficients(sample, model));
  EXPECT_EQ(model.focalLength, data_.truth.focalLength);
  for (int i = 0; i < 44; ++i) all.push_back(i);
  problem.optimizeModelCoefficients(all, model, refined);
  EXPECT_EQ(refined.focalLength, data_.truth.focalLength);
  EXPECT_TRUE(test::isFocalPoseNear(refined, data_.truth, 0.01, 0.3));
}

// The distorted image with its distortion known is the pinhole image.
TEST_F(SacProblem, KnownDistortionIsRemovedFirst) {
  const double distortion = -2e-7;
  test::MinimalProblem seen = data_;
  const auto distortImagePoint = [&](auto& match) {
    const Eigen::Vector3d image = *distort(distortion, {match.u, match.v, 1});
    match.u = image[0];
    match.v = image[1];
  };
  for (auto& ray : seen.rays) distortImagePoint(ray);
  for (auto& point : seen.points) distortImagePoint(point);
  const NoncentralHybridAdapter adapter = test::makeAdapter(seen);
  const HybridPoseSacProblem known(adapter, Solver::H13f, kReprojectionPx, kEpipolarPx, 1, {}, distortion);
  const HybridPoseSacProblem ignored(adapter, Solver::H13f, kReprojectionPx, kEpipolarPx, 1);
  const std::vector<int> all = *known.getIndices();
  std::vector<double> withLens, without;
  known.getSelectedDistancesToModel(data_.truth, all, withLens);
  ignored.getSelectedDistancesToModel(data_.truth, all, without);
  EXPECT_LT(*std::max_element(withLens.begin(), withLens.end()), 1e-6);
  EXPECT_GT(*std::max_element(without.begin(), without.end()), 0.1);
}

TEST_F(SacProblem, DistortionWithoutViewingDirectionsIsNamed) {
  const auto problem = [&](double distortion) {
    HybridPoseSacProblem(adapter_, Solver::H13f, kReprojectionPx, kEpipolarPx, 1, {}, distortion);
  };
  test::expectRefused("distortion", [&] { problem(-1); });
  test::expectRefused("distortion", [&] { problem(std::numeric_limits<double>::infinity()); });
}

TEST_F(SacProblem, DegenerateSampleHasNoModel) {
  for (solvers::PointMatch& match : data_.points) match.point = data_.points[0].point;
  const NoncentralHybridAdapter adapter = test::makeAdapter(data_);
  for (const Solver solver : allSolvers()) {
    const std::optional<double> focalLength = test::focalLengthFor(solver, data_.truth.focalLength);
    HybridPoseSacProblem problem(adapter, solver, kReprojectionPx, kEpipolarPx, 0, focalLength);
    if (multi(solver).getSampleSizes()[1] < 2) continue;
    int unused = 0;
    std::vector<int> sample;
    problem.getSamples(unused, sample);
    EXPECT_FALSE(sample.empty());  // the loop goes on, without a word on the console
    FocalPose model;
    EXPECT_FALSE(problem.computeModelCoefficients(sample, model));
  }
}

double truncatedCost(HybridPoseSacProblem& problem, const FocalPose& pose) {
  std::vector<double> distances;
  problem.getDistancesToModel(pose, distances);
  double sum = 0;
  for (double distance : distances) sum += std::min(distance * distance, 1.0);
  return sum;
}

TEST_F(SacProblem, ModelIsTheSolutionThatExplainsTheDataBest) {
  test::addNoise(random_, 1, data_);
  test::addOutliers(random_, 4, data_);
  const NoncentralHybridAdapter adapter = test::makeAdapter(data_);
  HybridPoseSacProblem problem(adapter, Solver::H13f, kReprojectionPx, kEpipolarPx);
  int unused = 0, severalSolutions = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<int> sample;
    problem.getSamples(unused, sample);
    FocalPose model;
    const bool found = problem.computeModelCoefficients(sample, model);
    const FocalPoses solutions =
        hybridgv::hybrid_pose::h13f(adapter, {{sample[0]}, {sample[1] - 24, sample[2] - 24, sample[3] - 24}});
    ASSERT_EQ(found, !solutions.empty());
    if (!found) continue;
    severalSolutions += solutions.size() > 1;
    double best = std::numeric_limits<double>::infinity();
    for (const FocalPose& solution : solutions) best = std::min(best, truncatedCost(problem, solution));
    EXPECT_EQ(truncatedCost(problem, model), best);
  }
  EXPECT_GT(severalSolutions, 20);
}

TEST_F(SacProblem, AdapterIsNotNeededAfterConstruction) {
  auto adapter = std::make_unique<NoncentralHybridAdapter>(adapter_);
  HybridPoseSacProblem problem(*adapter, Solver::P4Pf, kReprojectionPx, kEpipolarPx);
  adapter.reset();
  EXPECT_EQ(problem.countWithinDistance(data_.truth, 1.0), 44);
  FocalPose refined;
  problem.optimizeModelCoefficients(*problem.getIndices(), data_.truth, refined);
  EXPECT_TRUE(test::isFocalPoseNear(refined, data_.truth, 1e-6));
}

TEST_F(SacProblem, TooFewCorrespondencesAreAWrongCall) {
  const auto construct = [this](const std::vector<int>& rays, int points, Solver solver) {
    const NoncentralHybridAdapter adapter = test::makeAdapter(test::makeMinimalProblem(random_, rays, points));
    HybridPoseSacProblem(adapter, solver, 1, 1);
    MultiHybridPoseSacProblem(adapter, solver, 1, 1);
  };
  construct({}, 4, Solver::P4Pf);
  construct({1}, 3, Solver::H13f);
  construct({2, 1}, 2, Solver::H32f);
  construct({2, 3}, 1, Solver::H51f);
  test::expectRefused("3 2D-3D correspondences, p4pf needs 4", [&] { construct({9}, 3, Solver::P4Pf); });
  test::expectRefused("3 2D-3D correspondences, p35pf needs 4", [&] { construct({9}, 3, Solver::P35Pf); });
  test::expectRefused("0 2D-2D correspondences, h13f needs 1", [&] { construct({}, 9, Solver::H13f); });
  test::expectRefused("2 2D-3D correspondences, h13f needs 3", [&] { construct({9}, 2, Solver::H13f); });
  test::expectRefused("2 2D-2D correspondences, h32f needs 3", [&] { construct({2}, 9, Solver::H32f); });
  test::expectRefused("1 2D-3D correspondences, h32f needs 2", [&] { construct({9}, 1, Solver::H32f); });
  test::expectRefused("4 2D-2D correspondences, h51f needs 5", [&] { construct({4}, 9, Solver::H51f); });
  test::expectRefused("0 2D-3D correspondences, h51f needs 1", [&] { construct({9}, 0, Solver::H51f); });
}

TEST_F(SacProblem, WrongThresholdsAndIndicesAreNamed) {
  for (double wrong : {0., -1., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    test::expectRefused("maxReprojectionErrorPx", [&] { HybridPoseSacProblem(adapter_, Solver::H13f, wrong, 1); });
    test::expectRefused("maxEpipolarErrorPx", [&] { MultiHybridPoseSacProblem(adapter_, Solver::H13f, 1, wrong); });
  }
  HybridPoseSacProblem problem = flat(Solver::H13f);
  FocalPose model;
  std::vector<double> distances;
  test::expectRefused("index 44", [&] { problem.getSelectedDistancesToModel(model, {44}, distances); });
  test::expectRefused("index -1", [&] { problem.getSelectedDistancesToModel(model, {-1}, distances); });
  test::expectRefused("got 2 and 2", [&] { problem.computeModelCoefficients({0, 1, 24, 25}, model); });
  MultiHybridPoseSacProblem multiProblem = multi(Solver::H13f);
  test::expectRefused("index 20", [&] { multiProblem.computeModelCoefficients({{0}, {1, 2, 20}}, model); });
  test::expectRefused("needs two lists", [&] { multiProblem.isSampleGood({{0}}); });
}

// An adapter of the user's own may hold anything.
class BrokenAdapter : public NoncentralHybridAdapter {
 public:
  explicit BrokenAdapter(const NoncentralHybridAdapter& good) : NoncentralHybridAdapter(good) {}
  Eigen::Vector3d getBearingVector(std::size_t index) const override {
    return index == 3 ? Eigen::Vector3d(std::numeric_limits<double>::quiet_NaN(), 0, 1)
                      : NoncentralHybridAdapter::getBearingVector(index);
  }
};

TEST_F(SacProblem, BearingVectorThatIsNotANumberIsNamed) {
  const BrokenAdapter broken(adapter_);
  test::expectRefused("getBearingVector(3)", [&] { HybridPoseSacProblem(broken, Solver::H13f, 1, 1); });
}

}  // namespace
}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
