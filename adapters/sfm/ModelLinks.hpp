// Turns the ids of COLMAP's files into indices, and makes images and tracks tell the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "Mending.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// The indices of the things of one kind by their ids. An id is looked up for every observation, so that small ids, which are the
// rule, have a table of their own; the others are in a hash table with open addressing.
class IdIndex {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);     // there is no such id
  static constexpr std::size_t kLeftOut = static_cast<std::size_t>(-2);  // there is, but the thing has been left out

  explicit IdIndex(const char* kind) : kind_(kind) {}
  // How many ids there will be: with that, ids in any order are recognized as small.
  void reserve(std::size_t count) { reserved_ = count; }
  // Empty, or what is wrong: the id has occurred before.
  std::string add(std::uint64_t id, std::size_t index);
  // The index, kNone or kLeftOut.
  std::size_t find(std::uint64_t id) const {
    if (id < small_.size() && small_[static_cast<std::size_t>(id)] != kFree) return widened(small_[static_cast<std::size_t>(id)]);
    return slots_.empty() ? kNone : findInSlots(id);
  }
  // "there is no image 7"
  std::string unknown(std::uint64_t id) const;

 private:
  static constexpr std::uint32_t kFree = static_cast<std::uint32_t>(-1), kSmallLeftOut = static_cast<std::uint32_t>(-2);
  struct Slot {
    std::uint64_t id;
    std::size_t index;  // kNone: free
  };
  static std::size_t widened(std::uint32_t index) { return index == kSmallLeftOut ? kLeftOut : index; }
  bool isSmall(std::uint64_t id, std::size_t index) const;
  void addSmall(std::size_t id, std::size_t index);
  void addSlot(std::uint64_t id, std::size_t index);
  std::size_t findInSlots(std::uint64_t id) const;
  std::size_t firstSlot(std::uint64_t id) const { return static_cast<std::size_t>(id * 0x9e3779b97f4a7c15ULL >> shift_); }
  void grow();

  const char* kind_;
  std::size_t reserved_ = 0, count_ = 0;
  std::vector<std::uint32_t> small_;  // by id
  std::vector<Slot> slots_;           // a power of two of them, at most half of them taken
  std::size_t taken_ = 0;
  int shift_ = 64;
};

// Tracks as the files have them: those of point i are entries[begins[i]] up to entries[begins[i + 1]].
struct TrackEntry {
  std::uint32_t imageId = 0, observation = 0;
};
struct Tracks {
  std::vector<TrackEntry> entries;
  std::vector<std::size_t> begins{0};
  std::vector<std::size_t> places;  // line or byte offset of each point's track
};

// Gives the points their tracks. Where tracks and images contradict each other, what the images say counts: see Mend.
// `errorAt(i, reason)` makes the error for tracks of point i, `imagesError(reason)` one for the images.
void linkTracks(const Tracks& tracks, const IdIndex& imageIndex,
                const std::function<FileError(std::size_t, const std::string&)>& errorAt,
                const std::function<FileError(const std::string&)>& imagesError, Mending& mending, SparseModel& model);

// The rotation camera -> model and the centre of x_camera = R(q) X + t, q = (w, x, y, z) of any length. Empty, or what is wrong.
std::string setPoseFromQuaternion(const double q[4], const Eigen::Vector3d& translation, Image& image);

// The same for a rotation matrix, which must be one to 1e-3; the nearest rotation is taken.
std::string setPoseFromMatrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation, Image& image);

}  // namespace sfm
}  // namespace hybridgv
