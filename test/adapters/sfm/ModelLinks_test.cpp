#include "ModelLinks.hpp"

#include <gtest/gtest.h>

#include <map>

#include "Random.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// Ids of every kind, in any order, with and without the number announced: the same answers as std::map's.
TEST(IdIndex, FindsWhatWasAdded) {
  test::Random random(test::testSeed(), 50);
  const auto anyId = [&](int kind) -> std::uint64_t {
    const auto small = static_cast<std::uint64_t>(random.index(40000));
    switch (kind) {
      case 0:
        return small;
      case 1:
        return small << 40;  // equal in the low bits
      case 2:
        return ~small;
      default:
        return random.index(2) == 0 ? small : small * 0x123456789abcdefULL;
    }
  };
  for (int kind = 0; kind < 4; ++kind)
    for (const std::size_t announced : {0, 5000}) {
      IdIndex index("thing");
      index.reserve(announced);
      std::map<std::uint64_t, std::size_t> expected;
      for (std::size_t i = 0; i < 5000; ++i) {
        const std::uint64_t id = anyId(kind);
        const std::size_t value = i % 7 == 0 ? IdIndex::kLeftOut : i;
        const bool isNew = expected.emplace(id, value).second;
        EXPECT_EQ(index.add(id, value).empty(), isNew) << id;
      }
      for (const auto& [id, value] : expected) ASSERT_EQ(index.find(id), value) << id;
      for (int i = 0; i < 5000; ++i) {
        const std::uint64_t id = anyId(kind);
        const auto entry = expected.find(id);
        ASSERT_EQ(index.find(id), entry == expected.end() ? IdIndex::kNone : entry->second) << id;
      }
    }
}

TEST(IdIndex, NamesTheIdThatOccursTwice) {
  IdIndex index("point");
  EXPECT_EQ(index.find(3), IdIndex::kNone);
  EXPECT_TRUE(index.add(3, 0).empty());
  EXPECT_EQ(index.add(3, 1), "point 3 occurs twice");
  EXPECT_EQ(index.unknown(4), "there is no point 4");
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv
