// What the writers demand of a model.
#pragma once

#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// std::invalid_argument that says what is wrong: indices that name nothing or contradict each other, ids that occur twice, values
// that are not finite, an image without a name or with a line break in it.
void checkModel(const SparseModel& model);

}  // namespace sfm
}  // namespace hybridgv
