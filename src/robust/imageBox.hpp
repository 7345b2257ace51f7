// The region of the query's image that its image points fill.
#pragma once

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/RobustBox.hpp"

namespace hybridgv {
namespace robust {

RobustBox::Size imageBox(const correspondences::CorrespondenceArrays& arrays);

}  // namespace robust
}  // namespace hybridgv
