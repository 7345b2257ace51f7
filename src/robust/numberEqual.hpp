// Numbers for things of which some are equal.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace hybridgv {
namespace robust {

using Key = std::uint64_t;

// A key that is equal for equal numbers, and as good as never for others.
template <class Number, std::size_t N>
Key keyOf(const std::array<Number, N>& numbers) {
  Key key = 0;
  for (const Number number : numbers) {
    const double value = static_cast<double>(number) + 0.0;  // -0 is 0
    Key bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    key = (key ^ bits) * 0x9e3779b97f4a7c15ULL;
    key = (key ^ (key >> 32)) * 0xbf58476d1ce4e5b9ULL;
    key ^= key >> 29;
  }
  return key;
}

// Equal keys get equal numbers 0, 1, .. in the order in which they occur first.
struct Numbering {
  std::vector<int> numbers;
  int count = 0;
};
Numbering numberEqual(const std::vector<Key>& keys);

}  // namespace robust
}  // namespace hybridgv
