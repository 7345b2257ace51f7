// Do the stored points lie where the images see them?
#pragma once

#include <string>

#include "Mending.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// Projects the points into the images of their tracks. If they miss their observations by many pixels in the median, either a
// common offset of each camera explains that, and its principal point is moved there (noted), or the model contradicts itself:
// FileError for `path` with the numbers. Fewer than 20 observations are no evidence.
void checkConsistency(const std::string& path, Mending& mending, SparseModel& model);

}  // namespace sfm
}  // namespace hybridgv
