#include "correspondences/numberCameras.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "Random.hpp"

namespace hybridgv {
namespace correspondences {
namespace {

RigRay rayFrom(const Eigen::Vector3d& centre, int index) {
  RigRay ray{};
  ray.match.centre = centre;
  ray.match.camera = index;
  return ray;
}

std::vector<int> numbersOf(std::vector<RigRay> rays) {
  numberCamerasByCentre(rays);
  std::vector<int> numbers;
  for (const RigRay& ray : rays) numbers.push_back(ray.match.camera);
  return numbers;
}

const Eigen::Vector3d kA(1, 2, 3), kB(1, 2, 4), kC(-1, 0, 0);

TEST(NumberCameras, KeepsTheOrderOfTheIndices) {
  EXPECT_EQ(numbersOf({rayFrom(kA, 7), rayFrom(kB, -3), rayFrom(kA, 7), rayFrom(kC, 100)}), (std::vector<int>{1, 0, 1, 2}));
}

TEST(NumberCameras, EqualCentresAreOneCameraWhateverTheIndices) {
  EXPECT_EQ(numbersOf({rayFrom(kA, 7), rayFrom(kB, 5), rayFrom(kA, 2)}), (std::vector<int>{0, 1, 0}));
}

TEST(NumberCameras, DifferentCentresAreDifferentCamerasWhateverTheIndex) {
  EXPECT_EQ(numbersOf({rayFrom(kB, 0), rayFrom(kA, 0), rayFrom(kC, 0)}), (std::vector<int>{2, 1, 0}));
}

TEST(NumberCameras, NegativeZeroIsZero) {
  EXPECT_EQ(numbersOf({rayFrom({-0.0, 0, 1}, 0), rayFrom({0.0, -0.0, 1}, 1)}), (std::vector<int>{0, 0}));
}

TEST(NumberCameras, NoRaysAreNoError) { EXPECT_TRUE(numbersOf({}).empty()); }

TEST(NumberCameras, DoesNotDependOnTheOrderOfTheRays) {
  test::Random random(test::testSeed(), 900);
  std::vector<RigRay> rays;
  for (int i = 0; i < 300; ++i) rays.push_back(rayFrom({std::floor(random.uniform(0, 5)), 0, 0}, random.index(4)));
  std::vector<RigRay> backwards(rays.rbegin(), rays.rend());
  std::vector<int> numbers = numbersOf(rays), reversed = numbersOf(backwards);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_EQ(numbers, reversed);
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(numbers[i] == numbers[j], rays[i].match.centre == rays[j].match.centre);
}

// With a comparison of all pairs of centres this takes minutes.
TEST(NumberCameras, AMillionCentresAreNumberedAtOnce) {
  std::vector<RigRay> rays;
  for (int i = 0; i < 1000000; ++i) rays.push_back(rayFrom({0.001 * (i % 1000), 0.001 * (i / 1000), 1}, i));
  const std::vector<int> numbers = numbersOf(std::move(rays));
  EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
  EXPECT_EQ(numbers.back(), 999999);
}

TEST(NumberCameras, OfASampleSaysWhoSharesACentre) {
  RayMatch rays[5] = {};
  const Eigen::Vector3d* const centres[] = {&kA, &kB, &kA, &kC, &kB};
  for (int i = 0; i < 5; ++i) rays[i].centre = *centres[i];
  numberCamerasOfSample(rays, 5);
  const std::vector<int> expected{0, 1, 0, 3, 1};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(rays[i].camera, expected[i]);
}

}  // namespace
}  // namespace correspondences
}  // namespace hybridgv
