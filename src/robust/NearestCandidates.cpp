#include "robust/NearestCandidates.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace robust {
namespace {

using math::Pair;

// A squared distance whose last digits are replaced by a place, so that one number is sorted instead of two.
constexpr std::uint64_t kPlaceBits = Candidates::kMost - 1;
static_assert((Candidates::kMost & kPlaceBits) == 0, "a power of two");

double withPlace(double squaredDistance, std::size_t place) {
  using Limits = std::numeric_limits<double>;
  const double positive = std::min(squaredDistance + Limits::min(), Limits::max());  // neither denormal nor infinite
  std::uint64_t bits;
  std::memcpy(&bits, &positive, sizeof bits);
  bits = (bits & ~kPlaceBits) | place;
  double result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

std::size_t placeOf(double withPlace) {
  std::uint64_t bits;
  std::memcpy(&bits, &withPlace, sizeof bits);
  return static_cast<std::size_t>(bits & kPlaceBits);
}

}  // namespace

void Candidates::reserve(std::size_t size) {
  index_.reserve(size);
  x_.reserve(size);
  y_.reserve(size);
  z_.reserve(size);
}

void Candidates::add(std::size_t index, const Eigen::Vector3d& position) {
  index_.push_back(index);
  x_.push_back(position[0]);
  y_.push_back(position[1]);
  z_.push_back(position[2]);
}

void Candidates::squaredDistancesFrom(const Eigen::Vector3d& position, double* result) const {
  const double x = position[0], y = position[1], z = position[2];
  for (std::size_t k = 0; k < size(); ++k) {
    const double dx = x_[k] - x, dy = y_[k] - y, dz = z_[k] - z;
    result[k] = dx * dx + dy * dy + dz * dz;
  }
}

// Every number sinks through a sorted list as far as it must, two numbers at once through a list each. No branch depends on them: it
// could not be foreseen.
static std::size_t findSmallest(const double* numbers, std::size_t size, std::array<double, Nearest::kFirst>& smallest) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Pair lists[Nearest::kFirst];
  for (Pair& pair : lists) pair = Pair{kNone, kNone};
  for (std::size_t k = 0; k < size; k += 2) {
    Pair sinking = {numbers[k], k + 1 < size ? numbers[k + 1] : kNone};
    for (Pair& pair : lists) {
      const Pair larger = math::larger(pair, sinking);
      pair = math::smaller(pair, sinking);
      sinking = larger;
    }
  }
  // Merged.
  std::size_t next[2] = {0, 0};
  for (double& number : smallest) {
    const double a = lists[next[0]][0], b = lists[next[1]][1];
    number = std::min(a, b);
    ++next[b < a];
  }
  return std::min(size, Nearest::kFirst);
}

static constexpr std::size_t kGroup = 8;

static double leastOfEight(const double* numbers) {
  Pair least{numbers[0], numbers[1]};
  for (std::size_t k = 2; k < kGroup; k += 2) least = math::smaller(least, Pair{numbers[k], numbers[k + 1]});
  return std::min(least[0], least[1]);
}

// Of groups of numbers, those with the least smallest ones hold the smallest of all; nobody looks at the others again.
std::size_t Nearest::findFirst(const double* squaredDistances, std::size_t size, std::array<std::size_t, kFirst>& first) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<double, Candidates::kMost> numbers;
  for (std::size_t k = 0; k < size; ++k) numbers[k] = withPlace(squaredDistances[k], k);
  const std::size_t groups = (size + kGroup - 1) / kGroup;
  for (std::size_t k = size; k < groups * kGroup; ++k) numbers[k] = kNone;
  std::array<double, Candidates::kMost / kGroup> leastOfGroup;
  for (std::size_t g = 0; g < groups; ++g) leastOfGroup[g] = leastOfEight(numbers.data() + g * kGroup);
  std::array<double, kFirst> smallest;
  const std::size_t chosen = findSmallest(leastOfGroup.data(), groups, smallest);
  // The last of these groups' smallest numbers has enough smaller ones.
  const double largest = chosen < kFirst ? kNone : smallest.back();
  std::array<double, kFirst * kGroup> left;
  std::size_t count = 0;
  for (std::size_t g = 0; g < chosen; ++g) {
    const double* const group = numbers.data() + placeOf(smallest[g]) / kGroup * kGroup;
    for (std::size_t k = 0; k < kGroup; ++k) {
      left[count] = group[k];
      count += group[k] <= largest;
    }
  }
  findSmallest(left.data(), count, smallest);
  const std::size_t found = std::min(size, kFirst);
  for (std::size_t k = 0; k < found; ++k) first[k] = placeOf(smallest[k]);
  return found;
}

void Nearest::insert(double distance, std::size_t index) {
  std::size_t k = size_ < kMost ? size_++ : size_ - 1;
  for (; k > 0 && distance < distance_[k - 1]; --k) {
    distance_[k] = distance_[k - 1];
    index_[k] = index_[k - 1];
  }
  distance_[k] = distance;
  index_[k] = index;
}

}  // namespace robust
}  // namespace hybridgv
