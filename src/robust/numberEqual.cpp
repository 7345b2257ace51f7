#include "robust/numberEqual.hpp"

namespace hybridgv {
namespace robust {

Numbering numberEqual(const std::vector<Key>& keys) {
  // A hash table with linear probing, at most half full, of the places where a key was first seen. The keys are hashes already.
  constexpr int kFree = -1;
  std::size_t size = 16;
  while (size < 2 * keys.size()) size *= 2;
  std::vector<int> slots(size, kFree);
  Numbering result;
  result.numbers.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::size_t slot = static_cast<std::size_t>(keys[i]) & (size - 1);
    const auto first = [&] { return static_cast<std::size_t>(slots[slot]); };
    while (slots[slot] != kFree && keys[first()] != keys[i]) slot = (slot + 1) & (size - 1);
    const bool isNew = slots[slot] == kFree;
    if (isNew) slots[slot] = static_cast<int>(i);
    result.numbers[i] = isNew ? result.count : result.numbers[first()];
    result.count += isNew;
  }
  return result;
}

}  // namespace robust
}  // namespace hybridgv
