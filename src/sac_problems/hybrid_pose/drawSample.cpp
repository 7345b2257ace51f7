#include "sac_problems/hybrid_pose/drawSample.hpp"

#include <algorithm>
#include <cstdint>

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

std::size_t drawIndex(std::size_t count, const std::function<int()>& random) {
  return static_cast<std::size_t>((static_cast<std::uint64_t>(random()) * count) >> 31);
}

std::vector<int> drawSubset(const std::vector<int>& list, int count, const std::function<int()>& random) {
  std::vector<int> subset;
  std::vector<std::size_t> taken;  // positions in the list, ascending
  for (int i = 0; i < count; ++i) {
    std::size_t position = drawIndex(list.size() - taken.size(), random);  // among those that are left
    for (std::size_t t : taken) position += position >= t;
    taken.insert(std::upper_bound(taken.begin(), taken.end(), position), position);
    subset.push_back(list[position]);
  }
  return subset;
}

std::vector<int> drawCamera(const std::vector<int>& list, const std::vector<int>& cameras, int needed,
                            const std::function<int()>& random) {
  const auto cameraOf = [&](int i) { return static_cast<std::size_t>(cameras[static_cast<std::size_t>(i)]); };
  std::vector<int> matches;
  for (int i : list) {
    if (matches.size() <= cameraOf(i)) matches.resize(cameraOf(i) + 1);
    ++matches[cameraOf(i)];
  }
  std::vector<int> candidates;
  for (int i : list)
    if (matches[cameraOf(i)] >= needed) candidates.push_back(i);
  if (candidates.empty()) return list;
  const std::size_t camera = cameraOf(candidates[drawIndex(candidates.size(), random)]);
  std::vector<int> result;
  for (int i : candidates)
    if (cameraOf(i) == camera) result.push_back(i);
  return result;
}

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
