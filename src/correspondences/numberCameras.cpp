#include "correspondences/numberCameras.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace hybridgv {
namespace correspondences {
namespace {

struct Camera {
  Eigen::Vector3d centre;
  int leastIndex;

  bool operator<(const Camera& other) const {
    if (leastIndex != other.leastIndex) return leastIndex < other.leastIndex;
    return std::lexicographical_compare(centre.data(), centre.data() + 3, other.centre.data(), other.centre.data() + 3);
  }
};

std::uint64_t hash(const Eigen::Vector3d& centre) {
  std::uint64_t result = 0;
  for (int k = 0; k < 3; ++k) {
    const double coordinate = centre[k] + 0.0;  // -0 becomes 0, which it is equal to
    std::uint64_t bits;
    std::memcpy(&bits, &coordinate, sizeof bits);
    result = (result ^ bits) * 0x9e3779b97f4a7c15ULL;
    result ^= result >> 32;
  }
  return result;
}

// The different centres in the order in which they are first asked for: a hash table with linear probing, at most half full.
class CameraTable {
 public:
  explicit CameraTable(std::size_t rays) {
    std::size_t size = 16;
    while (size < 2 * rays) size *= 2;
    slots_.assign(size, kFree);
  }

  int place(const Eigen::Vector3d& centre, int index) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hash(centre)) & mask;
    while (slots_[slot] != kFree && camera(slot).centre != centre) slot = (slot + 1) & mask;
    if (slots_[slot] == kFree) {
      slots_[slot] = static_cast<int>(cameras_.size());
      cameras_.push_back({centre, index});
    }
    camera(slot).leastIndex = std::min(camera(slot).leastIndex, index);
    return slots_[slot];
  }

  const std::vector<Camera>& cameras() const { return cameras_; }

 private:
  static constexpr int kFree = -1;

  Camera& camera(std::size_t slot) { return cameras_[static_cast<std::size_t>(slots_[slot])]; }

  std::vector<int> slots_;
  std::vector<Camera> cameras_;
};

// ranks[i]: how many entries are less than entry i.
std::vector<int> ranksOf(const std::vector<Camera>& cameras) {
  std::vector<int> order(cameras.size()), ranks(cameras.size());
  std::iota(order.begin(), order.end(), 0);
  const auto camera = [&](int place) -> const Camera& { return cameras[static_cast<std::size_t>(place)]; };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return camera(a) < camera(b); });
  for (std::size_t rank = 0; rank < order.size(); ++rank) ranks[static_cast<std::size_t>(order[rank])] = static_cast<int>(rank);
  return ranks;
}

// matchOf(i): the i-th ray.
template <class MatchOf>
void numberByCentre(std::size_t count, MatchOf matchOf) {
  CameraTable table(count);
  for (std::size_t i = 0; i < count; ++i) {
    RayMatch& match = matchOf(i);
    match.camera = table.place(match.centre, match.camera);
  }
  const std::vector<int> ranks = ranksOf(table.cameras());
  for (std::size_t i = 0; i < count; ++i) matchOf(i).camera = ranks[static_cast<std::size_t>(matchOf(i).camera)];
}

}  // namespace

void numberCamerasByCentre(std::vector<RigRay>& rays) {
  numberByCentre(rays.size(), [&](std::size_t i) -> RayMatch& { return rays[i].match; });
}

void numberCamerasByCentre(RayMatch* rays, std::size_t count) {
  numberByCentre(count, [&](std::size_t i) -> RayMatch& { return rays[i]; });
}

void numberCamerasOfSample(RayMatch* rays, int count) {
  for (int i = 0; i < count; ++i) {
    rays[i].camera = i;
    for (int j = 0; j < i && rays[i].camera == i; ++j)
      if (rays[j].centre == rays[i].centre) rays[i].camera = j;
  }
}

}  // namespace correspondences
}  // namespace hybridgv
