// Numbers for new things of a model.
#pragma once

#include <algorithm>
#include <cstdint>
#include <set>

namespace hybridgv {
namespace sfm {

// `wanted`, unless it is 0 or one of the things has it: then the smallest free number from 1 on.
template <class Iterator>
std::uint32_t freeId(Iterator begin, Iterator end, std::uint32_t wanted) {
  if (wanted != 0 && std::none_of(begin, end, [&](const auto& thing) { return thing.id == wanted; })) return wanted;
  std::set<std::uint32_t> taken;
  for (Iterator i = begin; i != end; ++i) taken.insert(i->id);
  std::uint32_t id = 1;
  while (taken.count(id) != 0) ++id;
  return id;
}

}  // namespace sfm
}  // namespace hybridgv
