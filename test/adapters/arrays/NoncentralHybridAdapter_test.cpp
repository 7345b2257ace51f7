#include "hybridgv/adapters/NoncentralHybridAdapter.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "expectRefused.hpp"

namespace hybridgv {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Lists {
  std::vector<Vector3d> image2d2d{{1, 2, 1}, {3, 4, 1}}, bearings{{0, 0, 1}, {0, 1, 1}};
  std::vector<int> cameras{1, 0};
  std::vector<Vector3d> offsets{{1, 0, 0}, {0, 1, 0}};
  std::vector<Matrix3d> rotations{Matrix3d::Identity(), -Matrix3d(Vector3d(1, 1, -1).asDiagonal())};
  std::vector<Vector3d> image2d3d{{5, 6, 1}}, points{{7, 8, 9}};

  NoncentralHybridAdapter adapter() const { return {image2d2d, bearings, cameras, offsets, rotations, image2d3d, points}; }
};

TEST(NoncentralHybridAdapter, GivesBackWhatItWasGiven) {
  const Lists lists;
  const NoncentralHybridAdapter adapter = lists.adapter();
  ASSERT_EQ(adapter.getNumberCorrespondences2d2d(), 2u);
  ASSERT_EQ(adapter.getNumberCorrespondences2d3d(), 1u);
  EXPECT_EQ(adapter.getImagePoint2d2d(1), lists.image2d2d[1]);
  EXPECT_EQ(adapter.getBearingVector(1), lists.bearings[1]);
  EXPECT_EQ(adapter.getCamIndex(0), 1);
  EXPECT_EQ(adapter.getCamOffset(0), lists.offsets[1]);
  EXPECT_EQ(adapter.getCamRotation(0), lists.rotations[1]);
  EXPECT_EQ(adapter.getImagePoint2d3d(0), lists.image2d3d[0]);
  EXPECT_EQ(adapter.getPoint(0), lists.points[0]);
  EXPECT_EQ(adapter.getRigFocalLength(0), 0);
  EXPECT_EQ(adapter.getWeight2d2d(0), 1);
  EXPECT_EQ(adapter.getWeight2d3d(0), 1);
}

TEST(NoncentralHybridAdapter, OutlivesTheVectorsItWasMadeFrom) {
  auto lists = std::make_unique<Lists>();
  const NoncentralHybridAdapter adapter = lists->adapter();
  lists.reset();
  EXPECT_EQ(adapter.getPoint(0), Vector3d(7, 8, 9));
}

TEST(NoncentralHybridAdapter, TellsFocalLengthsAndWeights) {
  NoncentralHybridAdapter adapter = Lists().adapter();
  adapter.setRigFocalLengths({500, 600});
  adapter.setWeights({0.1, 0.2}, {0.3});
  EXPECT_EQ(adapter.getRigFocalLength(0), 600);
  EXPECT_EQ(adapter.getWeight2d2d(1), 0.2);
  EXPECT_EQ(adapter.getWeight2d3d(0), 0.3);
}

TEST(NoncentralHybridAdapter, TellsFeatures) {
  NoncentralHybridAdapter adapter = Lists().adapter();
  EXPECT_LT(adapter.getFeature2d2d(1), 0);
  EXPECT_LT(adapter.getFeature2d3d(0), 0);
  adapter.setFeatures({5, -1}, {7});
  EXPECT_EQ(adapter.getFeature2d2d(0), 5);
  EXPECT_EQ(adapter.getFeature2d2d(1), -1);
  EXPECT_EQ(adapter.getFeature2d3d(0), 7);
  adapter.setFeatures({}, {8});
  EXPECT_LT(adapter.getFeature2d2d(0), 0);
  EXPECT_EQ(adapter.getFeature2d3d(0), 8);
}

void expectWrong(const std::string& argument, const std::function<void(Lists&)>& damage) {
  Lists lists;
  damage(lists);
  test::expectRefused(argument, [&] { lists.adapter(); });
}

TEST(NoncentralHybridAdapter, NamesTheWrongArgument) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  expectWrong("bearingVectors", [](Lists& l) { l.bearings.pop_back(); });
  expectWrong("camIndices", [](Lists& l) { l.cameras.push_back(0); });
  expectWrong("camRotations", [](Lists& l) { l.rotations.pop_back(); });
  expectWrong("points", [](Lists& l) { l.points.clear(); });
  expectWrong("camIndices[1]", [](Lists& l) { l.cameras[1] = 2; });
  expectWrong("camIndices[0]", [](Lists& l) { l.cameras[0] = -1; });
  expectWrong("imagePoints2d2d[0]", [&](Lists& l) { l.image2d2d[0][1] = nan; });
  expectWrong("imagePoints2d2d[1]", [](Lists& l) { l.image2d2d[1][2] = 0; });
  expectWrong("imagePoints2d3d[0]", [&](Lists& l) { l.image2d3d[0][0] = infinity; });
  expectWrong("bearingVectors[1]", [](Lists& l) { l.bearings[1].setZero(); });
  expectWrong("bearingVectors[0]", [&](Lists& l) { l.bearings[0][2] = nan; });
  expectWrong("camOffsets[0]", [&](Lists& l) { l.offsets[0][0] = infinity; });
  expectWrong("camRotations[1]", [](Lists& l) { l.rotations[1] *= 1.1; });
  expectWrong("camRotations[0]", [](Lists& l) { l.rotations[0] *= -1; });
  expectWrong("points[0]", [&](Lists& l) { l.points[0][2] = nan; });
  NoncentralHybridAdapter adapter = Lists().adapter();
  test::expectRefused("focalLengths", [&] { adapter.setRigFocalLengths({1}); });
  test::expectRefused("focalLengths[1]", [&] { adapter.setRigFocalLengths({1, -1}); });
  test::expectRefused("weights2d2d", [&] { adapter.setWeights({1}, {}); });
  test::expectRefused("features2d2d", [&] { adapter.setFeatures({1}, {}); });
  test::expectRefused("features2d3d", [&] { adapter.setFeatures({1, 2}, {3, 4}); });
  test::expectRefused("weights2d3d[0]", [&] { adapter.setWeights({}, {nan}); });
}

}  // namespace
}  // namespace hybridgv
