// How much the inliers of two poses have in common.
#pragma once

#include "robust/Evidence.hpp"

namespace hybridgv {
namespace robust {

struct Overlap {
  int onlyFirst = 0, onlySecond = 0, both = 0;
};

Overlap overlap(const InlierMasks& first, const InlierMasks& second);

// Less than half of the inliers of either pose are the other's too: they are answers of different correspondences, not one answer
// found twice.
bool areDifferent(const Overlap& overlap);

// What only the second pose explains, over what only the first one does.
double relativeSupport(const Overlap& overlap);

}  // namespace robust
}  // namespace hybridgv
