// Random choice without replacement.
#pragma once

#include <functional>
#include <vector>

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

// Uniform in 0 .. count-1, from uniform numbers 0 .. 2^31-1.
std::size_t drawIndex(std::size_t count, const std::function<int()>& random);

// `count` different entries of the list, every set and every order equally likely; the list has at least that many.
std::vector<int> drawSubset(const std::vector<int>& list, int count, const std::function<int()>& random);

// Those entries i of the list for which cameras[i] is one camera. It is chosen with a probability proportional to its number of
// entries, among the cameras with at least `needed`; the whole list if there is none. Cameras are numbered 0, 1, ..
std::vector<int> drawCamera(const std::vector<int>& list, const std::vector<int>& cameras, int needed,
                            const std::function<int()>& random);

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
