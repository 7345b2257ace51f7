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
std::size_t Nearest::findFirst(const double* squaredDistances, std::size_t size, std::array<std::size_t, kFirst>& first) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Pair smallest[kFirst];
  for (Pair& pair : smallest) pair = Pair{kNone, kNone};
  for (std::size_t k = 0; k < size; k += 2) {
    Pair sinking = {withPlace(squaredDistances[k], k), k + 1 < size ? withPlace(squaredDistances[k + 1], k + 1) : kNone};
    for (Pair& pair : smallest) {
      const Pair larger = math::larger(pair, sinking);
      pair = math::smaller(pair, sinking);
      sinking = larger;
    }
  }
  std::array<double, 2 * kFirst> all;
  for (std::size_t k = 0; k < kFirst; ++k) {
    all[2 * k] = smallest[k][0];
    all[2 * k + 1] = smallest[k][1];
  }
  std::sort(all.begin(), all.end());
  const std::size_t found = std::min(size, kFirst);
  for (std::size_t k = 0; k < found; ++k) first[k] = placeOf(all[k]);
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
