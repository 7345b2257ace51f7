#include "robust/Sampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "Random.hpp"

namespace hybridgv {
namespace {

using namespace robust;

std::vector<int> firstOnes(int count) {
  std::vector<int> list;
  for (int i = 0; i < count; ++i) list.push_back(i);
  return list;
}

// Rig camera k has raysOfCamera[k] rays.
std::vector<int> cameras(const std::vector<int>& raysOfCamera) {
  std::vector<int> result;
  for (std::size_t k = 0; k < raysOfCamera.size(); ++k)
    result.insert(result.end(), static_cast<std::size_t>(raysOfCamera[k]), static_cast<int>(10 * k));
  return result;
}

Sampler makeSampler(const std::vector<int>& raysOfCamera, int points, bool growingPools = false) {
  const std::vector<int> list = cameras(raysOfCamera);
  return {list, firstOnes(static_cast<int>(list.size())), firstOnes(points), growingPools};
}

TEST(RandomStream, StreamsOfDifferentSeedsOrNumbersDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (std::uint64_t stream = 0; stream < 20; ++stream) first.insert(RandomStream(seed, stream).next());
  EXPECT_EQ(first.size(), 400u);
  EXPECT_EQ(RandomStream(3, 4).next(), RandomStream(3, 4).next());
}

TEST(Sampler, DrawsDifferentCorrespondences) {
  const Sampler sampler = makeSampler({3, 7, 1, 5}, 6);
  for (const RayDraw rayDraw : {RayDraw::Uniform, RayDraw::OneCamera, RayDraw::AllButOne, RayDraw::Spread})
    for (int i = 0; i < 500; ++i) {
      RandomStream random(1, static_cast<std::uint64_t>(i));
      const DrawnSample sample = sampler.draw({5, 4, rayDraw}, 1, random);
      const std::set<int> rays(sample.rays, sample.rays + 5), points(sample.points, sample.points + 4);
      EXPECT_EQ(rays.size(), 5u);
      EXPECT_EQ(points.size(), 4u);
      EXPECT_TRUE(*rays.begin() >= 0 && *rays.rbegin() < 16 && *points.begin() >= 0 && *points.rbegin() < 6);
    }
}

std::map<int, int> raysPerCamera(const std::vector<int>& cameraOfRay, const DrawnSample& sample, int count) {
  std::map<int, int> result;
  for (int k = 0; k < count; ++k) ++result[cameraOfRay[static_cast<std::size_t>(sample.rays[k])]];
  return result;
}

TEST(Sampler, OneCameraDrawTakesAllRaysFromOneCameraThatHasEnough) {
  const std::vector<int> raysOfCamera = {3, 10, 4, 5};
  const Sampler sampler = makeSampler(raysOfCamera, 1);
  std::map<int, int> times;
  const int count = 6000;
  for (int i = 0; i < count; ++i) {
    RandomStream random(2, static_cast<std::uint64_t>(i));
    const auto perCamera = raysPerCamera(cameras(raysOfCamera), sampler.draw({5, 1, RayDraw::OneCamera}, 1, random), 5);
    ASSERT_EQ(perCamera.size(), 1u);
    ++times[perCamera.begin()->first];
  }
  EXPECT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[10], count * 10 / 15., 4 * std::sqrt(count * 2 / 9.));
}

// In proportion to the numbers of rays: the first camera's is 6 of 18, the others have too few for six; the last ray is any other.
TEST(Sampler, AllButOneDrawTakesTheLastRayFromAnotherCamera) {
  const std::vector<int> raysOfCamera = {5, 12, 6, 1};
  const Sampler sampler = makeSampler(raysOfCamera, 1);
  const std::vector<int> list = cameras(raysOfCamera);
  std::map<int, int> times, last;
  const int count = 18000;
  for (int i = 0; i < count; ++i) {
    RandomStream random(2, static_cast<std::uint64_t>(i));
    const DrawnSample sample = sampler.draw({7, 0, RayDraw::AllButOne}, 1, random);
    const auto perCamera = raysPerCamera(list, sample, 6);
    ASSERT_EQ(perCamera.size(), 1u);
    ASSERT_NE(list[static_cast<std::size_t>(sample.rays[6])], perCamera.begin()->first);
    EXPECT_EQ(10 * sampler.cameraOf(sample.rays[0]), perCamera.begin()->first);
    ++times[perCamera.begin()->first];
    if (perCamera.begin()->first == 10) ++last[sample.rays[6]];
  }
  EXPECT_NEAR(times[10], count * 12 / 18., 4 * std::sqrt(count * 2 / 9.));
  EXPECT_EQ(last.size(), 12u);
  for (const auto& entry : last) EXPECT_NEAR(entry.second, count * 12 / 18. / 12, 4 * std::sqrt(count / 18.)) << entry.first;
}

TEST(Sampler, SpreadDrawUsesAsManyCamerasAsPossible) {
  for (const std::vector<int>& raysOfCamera : {std::vector<int>{4, 4, 4, 4, 4, 4, 4}, {9, 9, 1}, {2, 7}, {20}}) {
    const Sampler sampler = makeSampler(raysOfCamera, 1);
    for (int i = 0; i < 200; ++i) {
      RandomStream random(3, static_cast<std::uint64_t>(i));
      const auto perCamera = raysPerCamera(cameras(raysOfCamera), sampler.draw({5, 1, RayDraw::Spread}, 1, random), 5);
      EXPECT_EQ(perCamera.size(), std::min<std::size_t>(5, raysOfCamera.size()));
      int least = 5, most = 0;
      for (const auto& [camera, rays] : perCamera) {
        if (rays < raysOfCamera[static_cast<std::size_t>(camera / 10)]) least = std::min(least, rays);
        most = std::max(most, rays);
      }
      EXPECT_LE(most - least, 1);
    }
  }
}

// With 35 subsets of 3 out of 7 and 35000 draws, each is expected 1000 times, with a standard deviation of 32.
TEST(Sampler, EverySubsetIsEquallyLikely) {
  const Sampler sampler = makeSampler({7}, 7);
  std::map<std::set<int>, int> points, rays;
  for (int i = 0; i < 35000; ++i) {
    RandomStream random(test::testSeed(), static_cast<std::uint64_t>(i));
    const DrawnSample sample = sampler.draw({3, 3, RayDraw::Uniform}, 1, random);
    ++points[std::set<int>(sample.points, sample.points + 3)];
    ++rays[std::set<int>(sample.rays, sample.rays + 3)];
  }
  ASSERT_EQ(points.size(), 35u);
  ASSERT_EQ(rays.size(), 35u);
  for (const auto& entry : points) EXPECT_NEAR(entry.second, 1000, 160);
  for (const auto& entry : rays) EXPECT_NEAR(entry.second, 1000, 160);
}

// Samples and draws of any size take no more time with many cameras than with few: a hundred thousand samples from as many cameras
// would take minutes if each looked at all of them.
TEST(Sampler, DrawsAsFastFromManyCameras) {
  std::vector<int> raysOfCamera(100000, 1);
  raysOfCamera[500] = 6;
  const Sampler sampler = makeSampler(raysOfCamera, 1);
  for (const RayDraw rayDraw : {RayDraw::OneCamera, RayDraw::Spread})
    for (int i = 0; i < 100000; ++i) {
      RandomStream random(7, static_cast<std::uint64_t>(i));
      const DrawnSample sample = sampler.draw({5, 1, rayDraw}, 1, random);
      const bool ofCamera500 = sample.rays[0] >= 500 && sample.rays[4] < 506;
      ASSERT_TRUE(ofCamera500 || rayDraw == RayDraw::Spread);
    }
}

TEST(Sampler, NeedsEnoughData) {
  const Sampler sampler = makeSampler({4, 4}, 3);
  EXPECT_TRUE(sampler.canDraw({5, 3, RayDraw::Uniform}));
  EXPECT_TRUE(sampler.canDraw({5, 3, RayDraw::Spread}));
  EXPECT_FALSE(sampler.canDraw({5, 3, RayDraw::OneCamera}));
  EXPECT_FALSE(sampler.canDraw({9, 3, RayDraw::Uniform}));
  EXPECT_TRUE(makeSampler({6, 1}, 0).canDraw({7, 0, RayDraw::AllButOne}));
  EXPECT_FALSE(makeSampler({5, 5}, 0).canDraw({7, 0, RayDraw::AllButOne}));
  EXPECT_FALSE(makeSampler({7}, 0).canDraw({7, 0, RayDraw::AllButOne}));
  EXPECT_FALSE(sampler.canDraw({0, 4, RayDraw::Uniform}));
}

TEST(Sampler, HypergeometricProbabilityByHand) {
  EXPECT_DOUBLE_EQ(hypergeometricAll(10, 4, 2), 4. / 10 * 3 / 9);
  EXPECT_DOUBLE_EQ(hypergeometricAll(10, 10, 4), 1);
  EXPECT_EQ(hypergeometricAll(10, 3, 4), 0);
  EXPECT_EQ(hypergeometricAll(0, 0, 0), 1);
}

// The frequency of samples without outliers is the stated probability.
TEST(Sampler, AllInlierProbabilityIsTheFrequencyOfSuchSamples) {
  struct Case {
    std::vector<int> raysOfCamera;
    int points;
  };
  for (const Case& c : {Case{{12, 3, 9, 1, 7, 8, 2}, 9}, Case{{30}, 5}, Case{{6, 8}, 12}, Case{{2, 2, 20}, 6}}) {
    test::Random choice(test::testSeed(), 40);
    const Sampler sampler = makeSampler(c.raysOfCamera, c.points);
    const std::vector<int> cameraOfRay = cameras(c.raysOfCamera);
    std::vector<char> inlierRays, inlierPoints;
    for (std::size_t i = 0; i < cameraOfRay.size(); ++i) inlierRays.push_back(choice.uniform() < 0.8);
    for (int i = 0; i < c.points; ++i) inlierPoints.push_back(choice.uniform() < 0.8);
    const InlierCounts inliers = sampler.count(inlierRays, inlierPoints);
    for (const SampleSize& size : {SampleSize{0, 4, RayDraw::Uniform},
                                   {1, 3, RayDraw::Uniform},
                                   {3, 2, RayDraw::Uniform},
                                   {5, 1, RayDraw::OneCamera},
                                   {5, 1, RayDraw::Spread},
                                   {4, 1, RayDraw::AllButOne},
                                   {5, 1, RayDraw::Uniform}}) {
      if (!sampler.canDraw(size)) continue;
      const int count = 20000;
      int good = 0;
      for (int i = 0; i < count; ++i) {
        RandomStream random(test::testSeed(), static_cast<std::uint64_t>(i));
        const DrawnSample sample = sampler.draw(size, 1, random);
        bool all = true;
        for (int k = 0; k < size.rays; ++k) all = all && inlierRays[static_cast<std::size_t>(sample.rays[k])];
        for (int k = 0; k < size.points; ++k) all = all && inlierPoints[static_cast<std::size_t>(sample.points[k])];
        good += all;
      }
      const double p = sampler.allInlierProbability(size, inliers);
      EXPECT_NEAR(good, count * p, 4.5 * std::sqrt(count * p * (1 - p)) + 1e-9)
          << size.rays << " rays " << size.points << " points, draw " << static_cast<int>(size.rayDraw);
    }
  }
}

TEST(Sampler, SeveralLastRaysMakeASampleGoodIfOneOfThemIs) {
  const Sampler sampler = makeSampler({8, 4}, 0);
  InlierCounts inliers;
  inliers.raysPerCamera = {7, 1};
  inliers.rays = 8;
  const double six = hypergeometricAll(8, 7, 6);
  EXPECT_DOUBLE_EQ(sampler.allInlierProbability({7, 0, RayDraw::AllButOne, 1}, inliers), six / 4);
  EXPECT_DOUBLE_EQ(sampler.allInlierProbability({7, 0, RayDraw::AllButOne, 2}, inliers), six * 7 / 16);
}

TEST(Sampler, GrowingPoolsStartWithTheFirstAndReachAll) {
  const Sampler sampler = makeSampler({50, 50}, 100, true);
  int largestEarly = 0, largestLate = 0;
  for (int i = 0; i < 200; ++i) {
    RandomStream early(5, static_cast<std::uint64_t>(i)), late(6, static_cast<std::uint64_t>(i));
    const DrawnSample first = sampler.draw({1, 3, RayDraw::Uniform}, 1, early);
    const DrawnSample last = sampler.draw({1, 3, RayDraw::Uniform}, 10000, late);
    largestEarly = std::max({largestEarly, first.points[0], first.points[1], first.points[2], first.rays[0]});
    largestLate = std::max({largestLate, last.points[0], last.points[1], last.points[2], last.rays[0]});
  }
  EXPECT_LT(largestEarly, 30);
  EXPECT_GT(largestLate, 90);
}

}  // namespace
}  // namespace hybridgv
