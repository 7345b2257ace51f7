// Turns the ids of COLMAP's files into indices, and checks that images and tracks tell the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// The indices of the things of one kind by their ids.
class IdIndex {
 public:
  explicit IdIndex(const char* kind) : kind_(kind) {}
  // Empty, or what is wrong: the id has occurred before.
  std::string add(std::uint64_t id);
  // False if there is no such id.
  bool find(std::uint64_t id, std::size_t& index) const;
  // "there is no image 7"
  std::string unknown(std::uint64_t id) const;

 private:
  const char* kind_;
  std::unordered_map<std::uint64_t, std::size_t> indices_;
};

// An element of a track before the images are known.
struct TrackEntry {
  std::uint64_t imageId = 0, observation = 0;
};

// Gives the points their tracks. `tracks[i]` belongs to model.points[i]. `fail(i, reason)` reports a fault in tracks[i] and does
// not return; an observation whose point does not list it is reported as a returned reason (empty: none).
std::string linkTracks(const std::vector<std::vector<TrackEntry>>& tracks, const IdIndex& imageIndex,
                       const std::function<void(std::size_t, const std::string&)>& fail, SparseModel& model);

// The rotation camera -> model and the centre of x_camera = R(q) X + t, q = (w, x, y, z) of any length. Empty, or what is wrong.
std::string setPoseFromQuaternion(const double q[4], const Eigen::Vector3d& translation, Image& image);

}  // namespace sfm
}  // namespace hybridgv
