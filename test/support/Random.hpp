// Random numbers that are the same on every compiler and standard library.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace hybridgv {
namespace test {

// splitmix64: every (seed, stream) gives an independent sequence.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(mix(seed + 0x9e3779b97f4a7c15ULL) ^ mix(~stream)) {}

  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15ULL); }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // 0 .. count-1
  int index(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }

  double normal() {  // Box-Muller, one of the pair
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * kPi * uniform());
  }
  Eigen::Vector3d vector(double low, double high) {
    const double x = uniform(low, high), y = uniform(low, high), z = uniform(low, high);
    return {x, y, z};
  }
  Eigen::Vector3d direction() {
    const double x = normal(), y = normal(), z = normal();
    return Eigen::Vector3d(x, y, z).normalized();
  }
  // Uniform over all rotations.
  Eigen::Matrix3d rotation() {
    const Eigen::Vector3d x = direction();
    const Eigen::Vector3d z = x.cross(direction()).normalized();
    Eigen::Matrix3d result;
    result << x, z.cross(x), z;
    return result;
  }

  static constexpr double kPi = 3.14159265358979323846;

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

// The seed of the random tests; the environment variable HYBRIDGV_TEST_SEED replaces it to try other instances.
inline std::uint64_t testSeed() {
  const char* value = std::getenv("HYBRIDGV_TEST_SEED");
  return value ? std::strtoull(value, nullptr, 10) : 20261122;
}

}  // namespace test
}  // namespace hybridgv
