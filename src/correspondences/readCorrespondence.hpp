// The correspondences of an adapter as plain data. No other part of the library calls an adapter's getters, and each is called
// once for a correspondence: what a getter answers a second time cannot matter.
#pragma once

#include "correspondences/Correspondence.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"

namespace hybridgv {
namespace correspondences {

struct Counts {
  std::size_t rays, points;
};

// How many correspondences the adapter has; std::invalid_argument for more of a kind than an int can count.
Counts readCounts(const hybrid_pose::HybridAdapterBase& adapter);

// The correspondences with these indices, in their order, the rays' cameras numbered by centre.
//
// These functions and the next two throw std::invalid_argument, with the getter's name, for a number that is not finite, a ray of length
// zero, a camRotation that is not a rotation, a negative focal length.
Correspondences readCorrespondences(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& rayIndices,
                                    const std::vector<int>& pointIndices);
// One of them. The ray's camera has the number that the adapter gives it.
RigRay readRigRay(const hybrid_pose::HybridAdapterBase& adapter, int index);
PointMatch readPoint(const hybrid_pose::HybridAdapterBase& adapter, int index);
// Features without a number are negative; if none has one, the list becomes empty.
void clearIfNoneIsKnown(std::vector<int>& features);
// The correspondences of a minimal sample: `count` correspondences of one kind, without an allocation.
void readSampleRays(const hybrid_pose::HybridAdapterBase& adapter, const int* indices, int count, RayMatch* rays);
void readSamplePoints(const hybrid_pose::HybridAdapterBase& adapter, const int* indices, int count, PointMatch* points);

// Qualities of correspondences; std::invalid_argument if they are not finite.
std::vector<double> readRayWeights(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
std::vector<double> readPointWeights(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);

}  // namespace correspondences
}  // namespace hybridgv
