// Correspondences of images that are not in the map.
#include "hybridgv/adapters/sfm/QueryImage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "SfmQuery.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using test::makeQuery;
using test::QueryScene;

QueryScene makeQueryScene(std::uint64_t stream, CameraModel model = CameraModel::SimpleRadial) {
  test::Random random(test::testSeed(), stream);
  return makeQuery(test::makeScene(random, 8, 150, 0.4, {CameraModel::SimpleRadial, CameraModel::OpenCV, model}), 2);
}

TEST(QueryImage, ExactMatchesGiveExactCorrespondences) {
  QueryScene scene = makeQueryScene(1);
  scene.query.knowledge = CameraKnowledge::Known;
  const LocalizationProblem problem = makeLocalizationProblem(scene.map, scene.query);
  const NoncentralHybridAdapter& a = problem.adapter;
  ASSERT_GT(problem.points2d3d.size(), 20u);
  ASSERT_GT(problem.points2d2d.size(), 2u);
  for (std::size_t i = 0; i < problem.points2d3d.size(); ++i) {
    EXPECT_EQ(a.getPoint(i), scene.map.points[problem.points2d3d[i]].position);
    EXPECT_LT(hybrid_pose::reprojectionError(scene.truth, a.getImagePoint2d3d(i), a.getPoint(i)), 1e-8);
  }
  for (std::size_t i = 0; i < problem.points2d2d.size(); ++i)
    EXPECT_LT(hybrid_pose::sampsonError(scene.truth, a.getImagePoint2d2d(i), a.getBearingVector(i), a.getCamOffset(i),
                                        a.getCamRotation(i), a.getRigFocalLength(i)),
              1e-8);
  EXPECT_FALSE(problem.reference);
  EXPECT_EQ(problem.imageName, scene.query.name);
}

// Points are weighted by how many images agree, and every keypoint is named.
TEST(QueryImage, VotesOfSeveralImagesAreOneCorrespondence) {
  const QueryScene scene = makeQueryScene(2);
  const LocalizationProblem problem = makeLocalizationProblem(scene.map, scene.query);
  ASSERT_EQ(problem.keypoints2d3d.size(), problem.points2d3d.size());
  ASSERT_EQ(problem.keypoints2d2d.size(), problem.points2d2d.size());
  for (std::size_t i = 0; i < problem.points2d3d.size(); ++i) {
    double votes = 0;
    for (const ImageMatches& matches : scene.query.matches)
      for (const auto& [keypoint, observation] : matches.pairs)
        votes += keypoint == problem.keypoints2d3d[i] &&
                 scene.map.images[matches.image].observations[observation].point == problem.points2d3d[i];
    EXPECT_EQ(problem.adapter.getWeight2d3d(i), votes);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(problem.keypoints2d3d[k] == problem.keypoints2d3d[i] && problem.points2d3d[k] == problem.points2d3d[i]);
    EXPECT_EQ(std::count(problem.keypoints2d2d.begin(), problem.keypoints2d2d.end(), problem.keypoints2d3d[i]), 0);
  }
}

TEST(QueryImage, ScoresWeighVotes) {
  QueryScene scene = makeQueryScene(3);
  for (ImageMatches& matches : scene.query.matches) matches.scores.assign(matches.pairs.size(), 0.25);
  const LocalizationProblem plain = makeLocalizationProblem(scene.map, makeQueryScene(3).query);
  const LocalizationProblem scored = makeLocalizationProblem(scene.map, scene.query);
  ASSERT_EQ(plain.points2d3d, scored.points2d3d);
  for (std::size_t i = 0; i < plain.points2d3d.size(); ++i)
    EXPECT_EQ(scored.adapter.getWeight2d3d(i), plain.adapter.getWeight2d3d(i) / 4);
}

// What COLMAP throws away: matches with observations that have no point, and those of points that are not certain.
TEST(QueryImage, MatchesWithoutACertainPointBecomeRays) {
  QueryScene scene = makeQueryScene(4);
  const LocalizationProblem before = makeLocalizationProblem(scene.map, scene.query);
  ASSERT_FALSE(before.points2d3d.empty());
  const std::size_t point = before.points2d3d[0], keypoint = before.keypoints2d3d[0];
  const double votes = before.adapter.getWeight2d3d(0);
  scene.map.points[point].position += 100 * Eigen::Vector3d::UnitX();
  const LocalizationProblem after = makeLocalizationProblem(scene.map, scene.query);
  EXPECT_EQ(after.points2d3d.size(), before.points2d3d.size() - 1);
  EXPECT_EQ(std::count(after.keypoints2d2d.begin(), after.keypoints2d2d.end(), keypoint), votes);

  for (const TrackElement& e : scene.map.points[point].track)
    scene.map.images[e.image].observations[e.observation].point = Observation::kNoPoint;
  scene.map.points[point].track.clear();
  EXPECT_EQ(makeLocalizationProblem(scene.map, scene.query).keypoints2d2d, after.keypoints2d2d);
}

TEST(QueryImage, CertainPointsMayBeFoundBeforehand) {
  QueryScene scene = makeQueryScene(11);
  scene.map.points[makeLocalizationProblem(scene.map, scene.query).points2d3d[3]].position[1] += 50;
  const LocalizationProblem anew = makeLocalizationProblem(scene.map, scene.query);
  LocalizationProblemOptions options;
  options.certainPoints = findCertainPoints(scene.map, options);
  const LocalizationProblem before = makeLocalizationProblem(scene.map, scene.query, options);
  EXPECT_EQ(before.points2d3d, anew.points2d3d);
  EXPECT_EQ(before.keypoints2d2d, anew.keypoints2d2d);
  scene.map.points.emplace_back();
  EXPECT_THROW(makeLocalizationProblem(scene.map, scene.query, options), std::invalid_argument);
}

TEST(QueryImage, RaysBesidePointsAreAnOption) {
  QueryScene scene = makeQueryScene(5);
  ASSERT_GE(scene.query.matches.size(), 2u);
  // The first keypoint with a point is matched with a feature without one too.
  const std::size_t keypoint = makeLocalizationProblem(scene.map, scene.query).keypoints2d3d[0];
  Image& image = scene.map.images[scene.query.matches[1].image];
  image.observations.push_back({500, 400, Observation::kNoPoint});
  scene.query.matches[1].pairs.push_back(
      {static_cast<std::uint32_t>(keypoint), static_cast<std::uint32_t>(image.observations.size() - 1)});
  LocalizationProblemOptions options;
  const std::size_t without = makeLocalizationProblem(scene.map, scene.query, options).keypoints2d2d.size();
  options.raysBesidePoints = true;
  EXPECT_EQ(makeLocalizationProblem(scene.map, scene.query, options).keypoints2d2d.size(), without + 1);
}

// Two points of one keypoint: RANSAC decides.
TEST(QueryImage, KeypointMayHaveTwoPoints) {
  QueryScene scene = makeQueryScene(6);
  const LocalizationProblem before = makeLocalizationProblem(scene.map, scene.query);
  ASSERT_GE(before.keypoints2d3d.size(), 2u);
  const std::size_t from = before.keypoints2d3d[0], to = before.keypoints2d3d[1];
  for (ImageMatches& matches : scene.query.matches)
    for (auto& pair : matches.pairs)
      if (pair[0] == from) pair[0] = static_cast<std::uint32_t>(to);
  const LocalizationProblem after = makeLocalizationProblem(scene.map, scene.query);
  EXPECT_EQ(after.points2d3d.size(), before.points2d3d.size());
  EXPECT_EQ(std::count(after.keypoints2d3d.begin(), after.keypoints2d3d.end(), to), 2);
}

TEST(QueryImage, UnknownCamerasKeepTheirDistortion) {
  const QueryScene scene = makeQueryScene(7);
  const Camera& camera = scene.query.camera;
  const LocalizationProblem problem = makeLocalizationProblem(scene.map, scene.query);
  for (std::size_t i = 0; i < problem.keypoints2d3d.size(); ++i) {
    const Keypoint& k = scene.query.keypoints[problem.keypoints2d3d[i]];
    EXPECT_EQ(problem.adapter.getImagePoint2d3d(i), Eigen::Vector3d(k.x - camera.parameters[1], k.y - camera.parameters[2], 1));
  }
  QueryScene bare = scene;  // without parameters: the middle of the image
  bare.query.camera.parameters.clear();
  const Keypoint& k = bare.query.keypoints[problem.keypoints2d3d[0]];
  EXPECT_EQ(makeLocalizationProblem(bare.map, bare.query).adapter.getImagePoint2d3d(0), Eigen::Vector3d(k.x - 500, k.y - 400, 1));
}

// Pixels that are not square are made so as undistort() does it.
TEST(QueryImage, PixelsAreMadeSquare) {
  QueryScene scene = makeQueryScene(8, CameraModel::Pinhole);
  const LocalizationProblem estimated = makeLocalizationProblem(scene.map, scene.query);
  scene.query.knowledge = CameraKnowledge::Known;
  const LocalizationProblem known = makeLocalizationProblem(scene.map, scene.query);
  ASSERT_FALSE(known.keypoints2d3d.empty());
  for (std::size_t i = 0; i < known.keypoints2d3d.size(); ++i)
    EXPECT_LT((known.adapter.getImagePoint2d3d(i) - estimated.adapter.getImagePoint2d3d(i)).norm(), 1e-9);
}

TEST(QueryImage, WhatIsNotUsedIsCounted) {
  QueryScene scene = makeQueryScene(9);
  scene.query.leftOut.watermarkPairs = 3;
  const std::size_t keypoint = makeLocalizationProblem(scene.map, scene.query).keypoints2d3d[0];
  scene.query.keypoints[keypoint].x = std::numeric_limits<double>::quiet_NaN();
  scene.query.matches[0].pairs.push_back({1000000, 0});
  scene.query.matches[0].pairs.push_back({0, 4000000000u});
  scene.map.images[scene.query.matches[1].image].registered = false;
  const LeftOut leftOut = makeLocalizationProblem(scene.map, scene.query).leftOut;
  EXPECT_EQ(leftOut.watermarkPairs, 3u);
  EXPECT_EQ(leftOut.keypointsNotUsable, 1u);
  EXPECT_EQ(leftOut.indicesOutOfRange, 2u);
  EXPECT_EQ(leftOut.imagesNotInMap, 1u);
}

TEST(QueryImage, WrongCallsAreNamed) {
  const auto expectThrow = [](const QueryScene& scene, const char* words) {
    try {
      makeLocalizationProblem(scene.map, scene.query);
      ADD_FAILURE() << words;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const QueryScene scene = makeQueryScene(10);
  QueryScene wrong = scene;
  wrong.query.matches[0].image = 99;
  expectThrow(wrong, "query.matches[0]: there is no image 99");
  wrong = scene;
  wrong.query.matches[1].scores = {1};
  expectThrow(wrong, "query.matches[1]: has");
  wrong = scene;
  wrong.query.camera = test::makeCamera(CameraModel::OpenCVFisheye);
  expectThrow(wrong, "OPENCV_FISHEYE cannot be estimated");
  wrong.query.knowledge = CameraKnowledge::Known;
  EXPECT_NO_THROW(makeLocalizationProblem(wrong.map, wrong.query));
  wrong.query.camera = test::makeCamera(CameraModel::Equirectangular);
  expectThrow(wrong, "without an image plane");
  wrong = scene;
  wrong.query.camera.parameters.clear();
  wrong.query.camera.width = 0;
  expectThrow(wrong, "neither a size nor a principal point");
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv
