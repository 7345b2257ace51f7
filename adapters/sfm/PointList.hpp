// The points of Bundler and NVM files, which are the same but for the direction of y and the words for things.
#pragma once

#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// Reads `count` points: X, colour, number of views, and each view as image, key, x, y. Adds them and their observations to the
// model, whose images have been read. `image` is the format's word for an image, `signOfY` turns its y axis downwards.
void readPointList(TextScanner& in, std::size_t count, const char* image, double signOfY, SparseModel& model);

// The shortest record of a point, one character per number and one blank after each.
constexpr std::size_t kListedPointBytes = std::size_t{7} * 2;

}  // namespace sfm
}  // namespace hybridgv
