#include "robust/RobustBox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Random.hpp"

namespace hybridgv {
namespace robust {
namespace {

RobustBox evenBox(test::Random& random, int count) {
  RobustBox box;
  for (int i = 0; i < count; ++i) box.add(random.uniform(-500, 500), random.uniform(-300, 300));
  return box;
}

TEST(RobustBox, IsTheImageThatIsFilledEvenly) {
  test::Random random(test::testSeed(), 9860);
  for (const int count : {100, 2000}) {
    const RobustBox::Size size = evenBox(random, count).size();
    EXPECT_NEAR(size.width, 1000, 2000. / std::sqrt(count));
    EXPECT_NEAR(size.height, 600, 1200. / std::sqrt(count));
    EXPECT_DOUBLE_EQ(size.area(), size.width * size.height);
  }
}

TEST(RobustBox, OnePointFarAwayAmongEightDoesNotDecide) {
  test::Random random(test::testSeed(), 9861);
  for (int i = 0; i < 100; ++i)
    for (const int count : {7, 18, 40, 300}) {
      RobustBox box = evenBox(random, count);
      box.add(i % 2 == 0 ? 1e6 : -1e6, 1e6);
      EXPECT_LT(box.size().width, 2000) << count;
      EXPECT_LT(box.size().height, 1200) << count;
    }
}

TEST(RobustBox, AnEighthFarAwayAtTheSameSideDoesNotDecide) {
  test::Random random(test::testSeed(), 9862);
  for (int i = 0; i < 100; ++i)
    for (const int strays : {1, 2, 10}) {
      RobustBox box = evenBox(random, 7 * strays + 3);
      for (int k = 0; k < strays; ++k) box.add(1e6, 0);
      EXPECT_LT(box.size().width, 6000) << strays;
      EXPECT_LT(box.size().height, 1000) << strays;
    }
}

// Where image points crowd in the middle, an outermost one of few is as a rule no stray.
TEST(RobustBox, OfAFewPointsHoldsNearlyAll) {
  test::Random random(test::testSeed(), 9863);
  double widths = 0, ranges = 0;
  for (int i = 0; i < 200; ++i) {
    RobustBox box;
    double least = 0, most = 0;
    for (int k = 0; k < 16; ++k) {
      const double u = random.uniform(-250, 250) + random.uniform(-250, 250);
      least = std::min(least, u);
      most = std::max(most, u);
      box.add(u, 0);
    }
    EXPECT_LE(box.size().width, most - least);
    widths += box.size().width;
    ranges += most - least;
  }
  EXPECT_GT(widths, 0.97 * ranges);
}

TEST(RobustBox, OfAFewPointsIsNoLargerThanTheyAre) {
  for (const int count : {1, 2, 3, 4, 5, 6, 7}) {
    RobustBox box;
    for (int i = 0; i < count; ++i) box.add(10 * i, 0);
    EXPECT_LE(box.size().width, 10 * (count - 1)) << count;
    EXPECT_GE(box.size().width, 10 * (count - 1) / 2.) << count;
  }
}

TEST(RobustBox, OfNoneOrOnePlaceHasNoSize) {
  EXPECT_EQ(RobustBox().size().area(), 0);
  RobustBox box;
  for (int i = 0; i < 10; ++i) box.add(3, 4);
  EXPECT_EQ(box.size().diagonal(), 0);
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv
