#pragma once

#include "robust/QueryPose.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

// The pose as the kernels read it.
PlainPose toPlain(const QueryPose& pose);

}  // namespace robust
}  // namespace hybridgv
