#pragma once

#include "hybridgv/types.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

// The pose as the kernels read it.
PlainPose toPlain(const FocalPose& pose);

}  // namespace robust
}  // namespace hybridgv
