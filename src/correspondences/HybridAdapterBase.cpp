#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"

namespace hybridgv {
namespace hybrid_pose {

HybridAdapterBase::~HybridAdapterBase() = default;
double HybridAdapterBase::getRigFocalLength(std::size_t /*index*/) const { return 0; }
double HybridAdapterBase::getWeight2d2d(std::size_t /*index*/) const { return 1; }
double HybridAdapterBase::getWeight2d3d(std::size_t /*index*/) const { return 1; }
int HybridAdapterBase::getFeature2d2d(std::size_t /*index*/) const { return -1; }
int HybridAdapterBase::getFeature2d3d(std::size_t /*index*/) const { return -1; }
bool HybridAdapterBase::allowsConcurrentReads() const { return false; }

}  // namespace hybrid_pose
}  // namespace hybridgv
