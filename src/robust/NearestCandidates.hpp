// The nearest of many points.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace hybridgv {
namespace robust {

// Points to search in, in columns.
class Candidates {
 public:
  static constexpr std::size_t kMost = 2048;

  void reserve(std::size_t size);
  // At most kMost; `index` is the caller's.
  void add(std::size_t index, const Eigen::Vector3d& position);
  std::size_t size() const { return index_.size(); }
  std::size_t index(std::size_t k) const { return index_[k]; }
  void squaredDistancesFrom(const Eigen::Vector3d& position, double* result) const;

 private:
  std::vector<std::size_t> index_;
  std::vector<double> x_, y_, z_;
};

// The nearest candidates, nearest first. Whether one counts is asked only if it is near; as a rule one of them does not, the point
// from which they are looked for.
class Nearest {
 public:
  static constexpr std::size_t kMost = 8, kFirst = kMost + 1;

  template <class Counts>
  Nearest(const Candidates& candidates, const Eigen::Vector3d& position, const Counts& counts) {
    std::array<double, Candidates::kMost> squaredDistances;
    candidates.squaredDistancesFrom(position, squaredDistances.data());
    std::array<std::size_t, kFirst> first;
    const std::size_t found = findFirst(squaredDistances.data(), candidates.size(), first);
    for (std::size_t k = 0; k < found && size_ < kMost; ++k)
      if (counts(candidates.index(first[k]))) index_[size_++] = candidates.index(first[k]);
    if (size_ == kMost || found == candidates.size()) return;
    size_ = 0;
    for (std::size_t k = 0; k < candidates.size(); ++k)
      if ((size_ < kMost || squaredDistances[k] < distance_[size_ - 1]) && counts(candidates.index(k)))
        insert(squaredDistances[k], candidates.index(k));
  }
  std::size_t size() const { return size_; }
  std::size_t operator[](std::size_t k) const { return index_[k]; }

 private:
  // The places of the smallest ones, smallest first, and their number.
  static std::size_t findFirst(const double* squaredDistances, std::size_t size, std::array<std::size_t, kFirst>& first);
  void insert(double distance, std::size_t index);

  std::size_t size_ = 0;
  std::array<double, kMost> distance_{};
  std::array<std::size_t, kMost> index_{};
};

}  // namespace robust
}  // namespace hybridgv
