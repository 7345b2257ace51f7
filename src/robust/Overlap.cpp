#include "robust/Overlap.hpp"

#include <algorithm>

namespace hybridgv {
namespace robust {
namespace {

void add(const std::vector<char>& first, const std::vector<char>& second, Overlap& sum) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool isFirst = first[i] != 0, isSecond = second[i] != 0;
    sum.both += isFirst && isSecond ? 1 : 0;
    sum.onlyFirst += isFirst && !isSecond ? 1 : 0;
    sum.onlySecond += isSecond && !isFirst ? 1 : 0;
  }
}

}  // namespace

Overlap overlap(const InlierMasks& first, const InlierMasks& second) {
  Overlap result;
  add(first.rays, second.rays, result);
  add(first.points, second.points, result);
  return result;
}

bool areDifferent(const Overlap& overlap) { return overlap.both < std::min(overlap.onlyFirst, overlap.onlySecond); }

double relativeSupport(const Overlap& overlap) {
  return static_cast<double>(overlap.onlySecond) / std::max(overlap.onlyFirst, 1);
}

}  // namespace robust
}  // namespace hybridgv
