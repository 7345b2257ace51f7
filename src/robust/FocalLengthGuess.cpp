#include "robust/FocalLengthGuess.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {

FocalLengthGuess FocalLengthGuess::around(double imageSize, double least, double most) {
  constexpr double kLean = 0.5, kOctaves = 1;  // leans to long focal lengths
  return {imageSize * std::exp2(kLean), kOctaves, least, most};
}

FocalLengthGuess FocalLengthGuess::near(double focalLength, double logDeviation, double least, double most) {
  constexpr double kLeastOctaves = 0.5, kDeviations = 2;
  return {focalLength, kLeastOctaves + kDeviations * logDeviation / std::log(2.), least, most};
}

double FocalLengthGuess::draw(math::RandomStream& random) const {
  return std::clamp(middle_ * std::exp2(random.uniform(-octaves_, octaves_)), least_, most_);
}

}  // namespace robust
}  // namespace hybridgv
