// A correspondence of an adapter as plain data. Throws std::invalid_argument unless it is finite, with a ray of non-zero length.
#pragma once

#include "correspondences/Correspondence.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"

namespace hybridgv {
namespace correspondences {

RayMatch readRay(const hybrid_pose::HybridAdapterBase& adapter, int index);
PointMatch readPoint(const hybrid_pose::HybridAdapterBase& adapter, int index);

}  // namespace correspondences
}  // namespace hybridgv
