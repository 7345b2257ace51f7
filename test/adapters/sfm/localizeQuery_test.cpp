#include "hybridgv/adapters/sfm/localizeQuery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "SfmQuery.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using test::makeQuery;
using test::QueryScene;
using test::Random;

constexpr double kNoisePx = 0.5;

// A query of camera `model` among images of two others, its keypoints with noise.
QueryScene makeNoisyScene(std::uint64_t stream, CameraModel model) {
  Random random(test::testSeed(), stream);
  QueryScene scene = makeQuery(test::makeScene(random, 9, 250, 0.5, {CameraModel::SimplePinhole, CameraModel::OpenCV, model}), 2);
  for (Keypoint& k : scene.query.keypoints) {
    k.x += kNoisePx * random.normal();
    k.y += kNoisePx * random.normal();
  }
  return scene;
}

double focalErrorPercent(const QueryLocalization& localization, const QueryScene& scene) {
  return 100 * std::abs(localization.camera.parameters.at(0) / scene.truth.focalLength - 1);
}

TEST(LocalizeQuery, FindsPoseAndCamera) {
  std::vector<double> focal, rotation;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const QueryScene scene = makeNoisyScene(i, CameraModel::SimplePinhole);
    const QueryLocalization result = localizeQuery(scene.map, scene.query);
    ASSERT_TRUE(result.success) << result.reason;
    EXPECT_TRUE(result.reason.empty());
    EXPECT_EQ(result.camera.model, CameraModel::SimplePinhole);
    EXPECT_EQ(result.camera.parameters.at(1), scene.query.camera.parameters.at(1));
    focal.push_back(focalErrorPercent(result, scene));
    rotation.push_back((result.result.pose.rotation - scene.truth.rotation).norm());
  }
  EXPECT_LT(test::median(focal), 0.5);
  EXPECT_LT(test::median(rotation), 2e-3);
}

// Of a lens with k1 = -0.11.
TEST(LocalizeQuery, FindsDistortion) {
  std::vector<double> focal, k1, ignored;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const QueryScene scene = makeNoisyScene(100 + i, CameraModel::SimpleRadial);
    const QueryLocalization result = localizeQuery(scene.map, scene.query);
    ASSERT_TRUE(result.success) << result.reason;
    ASSERT_EQ(result.camera.parameters.size(), 4u);
    EXPECT_EQ(result.camera.parameters[3], result.k1);
    EXPECT_FALSE(result.distortionIsLost);
    focal.push_back(focalErrorPercent(result, scene));
    k1.push_back(result.k1);
    QueryOptions pinhole;
    pinhole.estimateDistortion = false;
    const QueryLocalization wrong = localizeQuery(scene.map, scene.query, pinhole);
    EXPECT_EQ(wrong.k1, 0);
    ignored.push_back(wrong.success ? focalErrorPercent(wrong, scene) : 100);
  }
  EXPECT_LT(test::median(focal), 0.5);
  EXPECT_GT(test::median(ignored), test::median(focal));
  EXPECT_NEAR(test::median(k1), -0.11, 0.02);
}

// SIMPLE_PINHOLE has no place for it.
TEST(LocalizeQuery, TellsThatDistortionIsLost) {
  QueryScene scene = makeNoisyScene(120, CameraModel::SimpleRadial);
  scene.query.camera.model = CameraModel::SimplePinhole;
  scene.query.camera.parameters.pop_back();
  const QueryLocalization result = localizeQuery(scene.map, scene.query);
  ASSERT_TRUE(result.success) << result.reason;
  EXPECT_TRUE(result.distortionIsLost);
  EXPECT_EQ(result.camera.parameters.size(), 3u);
}

TEST(LocalizeQuery, PairsAddUp) {
  const QueryScene scene = makeNoisyScene(20, CameraModel::SimplePinhole);
  const QueryLocalization result = localizeQuery(scene.map, scene.query);
  ASSERT_EQ(result.pairs.size(), scene.query.matches.size());
  std::size_t rays = 0, votes = 0;
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    EXPECT_EQ(result.pairs[i].image, scene.query.matches[i].image);
    EXPECT_EQ(result.pairs[i].matches, scene.query.matches[i].pairs.size());
    rays += result.pairs[i].inliers2d2d;
    votes += result.pairs[i].inliers2d3d;
  }
  EXPECT_EQ(rays, static_cast<std::size_t>(result.result.numberInliers2d2d));
  double expected = 0;
  for (std::size_t i = 0; i < result.problem.points2d3d.size(); ++i)
    if (result.result.inliers2d3d[i] != 0) expected += result.problem.adapter.getWeight2d3d(i);
  EXPECT_EQ(static_cast<double>(votes), expected);
}

TEST(LocalizeQuery, KnownCamerasAreKept) {
  for (const CameraModel model : {CameraModel::SimpleRadial, CameraModel::OpenCV, CameraModel::SimpleFisheye}) {
    QueryScene scene = makeNoisyScene(30, model);
    scene.query.knowledge = CameraKnowledge::Known;
    const QueryLocalization result = localizeQuery(scene.map, scene.query);
    ASSERT_TRUE(result.success) << toString(model) << ": " << result.reason;
    EXPECT_EQ(result.camera.parameters, scene.query.camera.parameters);
    EXPECT_EQ(result.result.pose.focalLength, scene.truth.focalLength);
    EXPECT_LT((result.result.pose.position - scene.truth.position).norm(), 0.15);
  }
}

// Near the prior if there is something to find, anywhere otherwise.
TEST(LocalizeQuery, PriorsMayBeWrong) {
  for (const double factor : {0.9, 1.0, 3.0}) {
    QueryScene scene = makeNoisyScene(40, CameraModel::SimplePinhole);
    scene.query.knowledge = CameraKnowledge::Prior;
    scene.query.camera.parameters[0] *= factor;
    const QueryLocalization result = localizeQuery(scene.map, scene.query);
    ASSERT_TRUE(result.success) << factor << ": " << result.reason;
    EXPECT_LT(focalErrorPercent(result, scene), 2) << factor;
  }
}

TEST(LocalizeQuery, FailuresHaveReasons) {
  QueryScene scene = makeNoisyScene(50, CameraModel::SimplePinhole);
  QueryOptions options;
  options.minInliers = 100000;
  const QueryLocalization few = localizeQuery(scene.map, scene.query, options);
  EXPECT_FALSE(few.success);
  EXPECT_NE(few.reason.find("100000 are wanted"), std::string::npos) << few.reason;
  options = {};
  options.minInlierShare = 1;
  scene.query.keypoints[makeLocalizationProblem(scene.map, scene.query).keypoints2d3d[0]].x += 300;
  const QueryLocalization share = localizeQuery(scene.map, scene.query, options);
  EXPECT_FALSE(share.success);
  EXPECT_NE(share.reason.find("share of inliers ("), std::string::npos) << share.reason;
  for (Image& image : scene.map.images)
    for (Observation& o : image.observations) o.point = Observation::kNoPoint;
  scene.query.matches.resize(1);
  const QueryLocalization rays = localizeQuery(scene.map, scene.query);
  EXPECT_FALSE(rays.success);
  EXPECT_FALSE(rays.reason.empty());
  scene.query.matches.clear();
  EXPECT_EQ(localizeQuery(scene.map, scene.query).reason, "no matches with the map");
}

// Two images of the same camera know it better than one, and the one that knows nothing is told.
TEST(LocalizeQueries, OneCameraForAll) {
  std::vector<double> alone, together;
  for (std::uint64_t stream = 300; stream < 360; ++stream) {
    Random random(test::testSeed(), stream);
    // Images 2 and 5 have the same camera.
    SparseModel map =
        test::makeScene(random, 9, 120, 0.5, {CameraModel::Pinhole, CameraModel::OpenCV, CameraModel::SimplePinhole});
    const QueryScene first = makeQuery(map, 2), second = makeQuery(map, 5);
    test::forgetImage(map, 2);
    test::forgetImage(map, 5);
    std::vector<QueryImage> queries{first.query, second.query};
    for (QueryImage& query : queries) {
      const auto isQuery = [](const ImageMatches& m) { return m.image == 2 || m.image == 5; };
      query.matches.erase(std::remove_if(query.matches.begin(), query.matches.end(), isQuery), query.matches.end());
      for (Keypoint& k : query.keypoints) {
        k.x += random.normal();
        k.y += random.normal();
      }
    }
    // The second has few matches.
    for (ImageMatches& matches : queries[1].matches) matches.pairs.resize(std::min<std::size_t>(matches.pairs.size(), 8));
    const QueryLocalization single = localizeQuery(map, queries[1]);
    const std::vector<QueryLocalization> joint = localizeQueries(map, queries);
    ASSERT_EQ(joint.size(), 2u);
    ASSERT_TRUE(joint[0].success && joint[1].success);
    EXPECT_EQ(joint[0].camera.parameters, joint[1].camera.parameters);
    alone.push_back(single.success ? focalErrorPercent(single, second) : 100);
    together.push_back(focalErrorPercent(joint[1], second));
  }
  EXPECT_LT(test::median(together), test::median(alone));
  EXPECT_LT(test::median(together), 1.2);
}

TEST(LocalizeQueries, EstimatesAreWeighedAndThoseThatContradictTheOthersAreNotUsed) {
  EXPECT_FALSE(agree({}));
  const CameraEstimate one = agree({{1000, 10, 0.1}}).value();
  EXPECT_NEAR(one.focalLength, 1000, 1e-9);
  EXPECT_NEAR(one.deviation, 10, 1e-9);
  const CameraEstimate two = agree({{1000, 10, 0.1}, {1020, 20, 0.2}}).value();
  EXPECT_NEAR(two.focalLength, 1004, 1e-9);
  EXPECT_NEAR(two.k1, 0.12, 1e-12);
  EXPECT_NEAR(two.deviation, std::sqrt(80.0), 1e-9);
  EXPECT_NEAR(agree({{1000, 10, 0.1}, {1004, 10, 0.1}, {2000, 10, 0.5}}).value().focalLength, 1002, 1e-9);
  EXPECT_NEAR(agree({{1000, 0, 0.1}, {1002, 1e-6, 0.1}}).value().focalLength, 1001, 0.1);  // nobody is that sure
  EXPECT_THROW(agree({{-1, 1, 0}}), std::invalid_argument);
  EXPECT_THROW(agree({{1000, std::nan(""), 0}}), std::invalid_argument);
}

TEST(LocalizeQueries, CommonCamerasThatDoNotFitAreNotUsed) {
  const QueryScene scene = makeNoisyScene(80, CameraModel::SimplePinhole);
  const double f = scene.truth.focalLength;
  const QueryLocalization right = localizeQuery(scene.map, scene.query, CameraEstimate{f, 1, 0});
  ASSERT_TRUE(right.success);
  EXPECT_EQ(right.camera.parameters[0], f);
  const QueryLocalization wrong = localizeQuery(scene.map, scene.query, CameraEstimate{30 * f, 1, 0});
  ASSERT_TRUE(wrong.success);
  EXPECT_LT(focalErrorPercent(wrong, scene), 2);
}

TEST(LocalizeQueries, WrongCallsAreNamed) {
  const QueryScene scene = makeNoisyScene(70, CameraModel::SimplePinhole);
  std::vector<QueryImage> queries{scene.query, scene.query};
  queries[1].camera.width += 1;
  EXPECT_THROW(localizeQueries(scene.map, queries), std::invalid_argument);
  QueryOptions options;
  options.minInliers = -1;
  EXPECT_THROW(localizeQuery(scene.map, scene.query, options), std::invalid_argument);
  options = {};
  options.priorDeviation = -0.1;
  EXPECT_THROW(localizeQuery(scene.map, scene.query, options), std::invalid_argument);
  options = {};
  options.minInlierShare = 1.5;
  EXPECT_THROW(localizeQuery(scene.map, scene.query, options), std::invalid_argument);
  EXPECT_TRUE(localizeQueries(scene.map, {}).empty());
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv
