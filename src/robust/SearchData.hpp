// What a search works on: the correspondences in random order, and how samples are drawn from them.
#pragma once

#include <optional>
#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/Sampler.hpp"
#include "robust/WorkerPool.hpp"

namespace hybridgv {
namespace robust {

struct SearchData {
  std::vector<int> rayIndices, pointIndices;  // the adapter's indices of the arrays' entries
  correspondences::CorrespondenceArrays arrays;
  Sampler sampler;  // draws nothing from many of which only a part is searched in
};

// The query's, if it is known at all; else 0.
double roughlyKnownFocalLength(const sac::HybridRansacOptions& options);

// Reads everything that the adapter has; many correspondences by all workers. Throws std::invalid_argument for data or weights that are not
// finite.
SearchData readSearchData(const hybrid_pose::HybridAdapterBase& adapter, const sac::HybridRansacOptions& options,
                          WorkerPool& workers);

// Of all, those at these places of the arrays. The normalization stays that of all.
SearchData partAt(const std::vector<int>& rays, const std::vector<int>& points, const SearchData& all,
                  const hybrid_pose::HybridAdapterBase& adapter, const sac::HybridRansacOptions& options);

// A thousand of each kind tell as good as all where a pose is, and cost less. Every camera keeps rays. None if there are not more.
std::optional<SearchData> partOf(const SearchData& all, const hybrid_pose::HybridAdapterBase& adapter,
                                 const sac::HybridRansacOptions& options);

}  // namespace robust
}  // namespace hybridgv
