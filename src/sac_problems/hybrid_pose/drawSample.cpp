#include "sac_problems/hybrid_pose/drawSample.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

std::size_t drawIndex(std::size_t count, const std::function<int()>& random) {
  return static_cast<std::size_t>((static_cast<std::uint64_t>(random()) * count) >> 31);
}

std::vector<int> drawSubset(std::vector<int> list, int count, const std::function<int()>& random) {
  const auto size = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < size; ++i) std::swap(list[i], list[i + drawIndex(list.size() - i, random)]);
  list.resize(size);
  return list;
}

std::vector<int> drawCamera(const std::vector<int>& list, const std::vector<int>& cameras, int needed,
                            const std::function<int()>& random) {
  std::map<int, int> matches;
  for (int camera : cameras) ++matches[camera];
  std::vector<int> candidates;
  for (int camera : cameras)
    if (matches[camera] >= needed) candidates.push_back(camera);
  if (candidates.empty()) return list;
  const int chosen = candidates[drawIndex(candidates.size(), random)];
  std::vector<int> result;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (cameras[i] == chosen) result.push_back(list[i]);
  return result;
}

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
