#include "robust/GroupedArrays.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "HybridScene.hpp"
#include "correspondences/CorrespondenceArrays.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::CorrespondenceArrays;

constexpr std::size_t kGroups = 5, kEmptyGroup = 3;

std::vector<int> randomGroups(test::Random& random, std::size_t size) {
  std::vector<int> groups;
  while (groups.size() < size) {
    const int group = static_cast<int>(random.uniform(0, kGroups));
    if (group != static_cast<int>(kEmptyGroup)) groups.push_back(group);
  }
  return groups;
}

template <class Arrays>
void expectMembers(Arrays all, const std::vector<int>& groups) {
  GroupedArrays<Arrays> grouped;
  for (int time = 0; time < 2; ++time) {
    grouped.set(all, groups.data(), kGroups);
    for (std::size_t group = 0; group < kGroups; ++group) {
      Arrays members = grouped.of(group);
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < all.size; ++i)
        if (groups[i] == static_cast<int>(group)) expected.push_back(i);
      ASSERT_EQ(members.size, expected.size());
      const auto from = correspondences::columnsOf(all), to = correspondences::columnsOf(members);
      for (std::size_t column = 0; column < from.size(); ++column)
        for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ((*to[column])[k], (*from[column])[expected[k]]);
    }
    all.size /= 2;  // set again
  }
}

TEST(GroupedArrays, HaveTheMembersOfEachGroupInTheirOrder) {
  test::Random random(test::testSeed(), 9600);
  test::SceneOptions options;
  options.rays = 77;
  options.points = 50;
  const test::HybridScene scene = test::makeHybridScene(random, options);
  const CorrespondenceArrays arrays(scene.adapter(), correspondences::allIndices(77), correspondences::allIndices(50));
  expectMembers(arrays.rayArrays(), randomGroups(random, 77));
  expectMembers(arrays.pointArrays(), randomGroups(random, 50));
}

TEST(GroupedArrays, KeepTheNarrowing) {
  test::Random random(test::testSeed(), 9601);
  test::SceneOptions options;
  options.rays = 77;
  const test::HybridScene scene = test::makeHybridScene(random, options);
  const CorrespondenceArrays arrays(scene.adapter(), correspondences::allIndices(77), {});
  std::vector<double> values(77);
  for (double& value : values) value = random.uniform(1, 3);
  const correspondences::PaddedValues narrowing(values, 1);
  RayArrays rays = arrays.rayArrays();
  rays.narrowing = narrowing.pointer();
  const std::vector<int> groups = randomGroups(random, 77);
  GroupedArrays<RayArrays> grouped;
  grouped.set(rays, groups.data(), kGroups);
  for (std::size_t group = 0; group < kGroups; ++group) {
    const RayArrays members = grouped.of(group);
    ASSERT_TRUE(members.narrowing);
    std::size_t k = 0;
    for (std::size_t i = 0; i < 77; ++i) {
      if (groups[i] != static_cast<int>(group)) continue;
      EXPECT_EQ(*(members.narrowing + k++), values[i]);
    }
  }
}

TEST(GroupedArrays, OfNoGroupsAreEmpty) {
  GroupedArrays<PointArrays> grouped;
  grouped.set(PointArrays(), nullptr, 0);
  grouped.set(PointArrays(), nullptr, 1);
  EXPECT_EQ(grouped.of(0).size, 0u);
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv
