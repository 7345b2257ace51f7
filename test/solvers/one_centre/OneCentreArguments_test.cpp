// The public functions of the one-centre problems: what they return for a good call, and how they refuse a wrong one.
#include <gtest/gtest.h>

#include <limits>

#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "expectRefused.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/relative_pose/methods.hpp"

namespace hybridgv {
namespace test {
namespace {

// Seven rays of camera 0, one of camera 1, two points.
NoncentralHybridAdapter exampleAdapter() {
  Random random(testSeed() + 20);
  return makeAdapter(makeMinimalProblem(random, {7, 1}, 2));
}

TEST(SixptOnefocal, PublicFunctionRefusesWrongCalls) {
  const NoncentralHybridAdapter adapter = exampleAdapter();
  const struct {
    const char* name;
    std::vector<int> indices;
    const char* text;
  } cases[] = {
      {"too few", {0, 1, 2, 3, 4}, "needs 6 indices, got 5"},
      {"none", {}, "needs 6 indices, got 0"},
      {"negative", {0, 1, 2, 3, 4, -1}, "index -1"},
      {"too large", {0, 1, 2, 3, 4, 8}, "index 8"},
      {"repeated", {0, 1, 2, 3, 4, 2}, "index 2 is repeated"},
      {"two rig cameras", {0, 1, 2, 3, 4, 7}, "correspondences 0 and 7 belong to different rig cameras"},
  };
  for (const auto& test : cases)
    expectRefused(test.name, test.text, [&] { relative_pose::sixpt_onefocal(adapter, test.indices); });
}

TEST(H51fOneCentre, PublicFunctionRefusesWrongCalls) {
  const NoncentralHybridAdapter adapter = exampleAdapter();
  const struct {
    const char* name;
    std::vector<std::vector<int>> indices;
    const char* text;
  } cases[] = {
      {"one list", {{0, 1, 2, 3, 4}}, "needs two lists"},
      {"too few rays", {{0, 1, 2, 3}, {0}}, "indices[0] (2D-2D): needs 5 indices, got 4"},
      {"no point", {{0, 1, 2, 3, 4}, {}}, "indices[1] (2D-3D): needs 1 indices, got 0"},
      {"ray out of range", {{0, 1, 2, 3, 8}, {0}}, "index 8"},
      {"point out of range", {{0, 1, 2, 3, 4}, {2}}, "index 2"},
      {"repeated ray", {{0, 1, 2, 3, 0}, {0}}, "index 0 is repeated"},
  };
  for (const auto& test : cases) expectRefused(test.name, test.text, [&] { hybrid_pose::h51f(adapter, test.indices); });
}

// An adapter with a value that is not finite: NoncentralHybridAdapter refuses to hold one.
class BrokenAdapter : public NoncentralHybridAdapter {
 public:
  BrokenAdapter() : NoncentralHybridAdapter(exampleAdapter()) {}
  Eigen::Vector3d getBearingVector(std::size_t index) const override {
    return index == 3 ? Eigen::Vector3d(0, std::numeric_limits<double>::quiet_NaN(), 1)
                      : NoncentralHybridAdapter::getBearingVector(index);
  }
};

TEST(OneCentreFunctions, RefuseValuesThatAreNotFinite) {
  const BrokenAdapter adapter;
  expectRefused("sixpt_onefocal", "getBearingVector(3)", [&] { relative_pose::sixpt_onefocal(adapter); });
  expectRefused("h51f", "getBearingVector(3)", [&] { hybrid_pose::h51f(adapter); });
}

TEST(OneCentreFunctions, SolveTheCorrespondencesOfTheIndices) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random random(testSeed() + 21, i);
    const MinimalProblem problem = makeMinimalProblem(random, {1, 7}, 3);  // correspondence 0 belongs to another camera
    const NoncentralHybridAdapter adapter = makeAdapter(problem);
    EXPECT_TRUE(hasFocalPoseNear(relative_pose::sixpt_onefocal(adapter, {7, 2, 5, 3, 1, 4}), problem.truth, 1e-6)) << i;
    EXPECT_TRUE(hasFocalPoseNear(hybrid_pose::h51f(adapter, {{7, 2, 5, 3, 1}, {2}}), problem.truth, 1e-6)) << i;
  }
}

TEST(OneCentreFunctions, TakeTheFirstCorrespondencesWithoutIndices) {
  Random random(testSeed() + 22);
  const NoncentralHybridAdapter adapter = makeAdapter(makeMinimalProblem(random, {7}, 2));
  const FocalPoses six = relative_pose::sixpt_onefocal(adapter),
                   sixByIndex = relative_pose::sixpt_onefocal(adapter, {0, 1, 2, 3, 4, 5});
  const FocalPoses h51f = hybrid_pose::h51f(adapter), h51fByIndex = hybrid_pose::h51f(adapter, {{0, 1, 2, 3, 4}, {0}});
  ASSERT_EQ(six.size(), sixByIndex.size());
  ASSERT_EQ(h51f.size(), h51fByIndex.size());
  for (std::size_t i = 0; i < six.size(); ++i) EXPECT_EQ(six[i].rotation, sixByIndex[i].rotation);
  for (std::size_t i = 0; i < h51f.size(); ++i) EXPECT_EQ(h51f[i].position, h51fByIndex[i].position);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv
