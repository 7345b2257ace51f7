// Random numbers that are the same on every compiler and standard library.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "math/RandomStream.hpp"

namespace hybridgv {
namespace test {

// Every (seed, stream) gives an independent sequence.
class Random : public math::SplitMix64 {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : SplitMix64(mix(seed + kStep) ^ mix(~stream)) {}

  // 0 .. count-1
  int index(int count) { return below(count); }

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
};

// The seed of the random tests; the environment variable HYBRIDGV_TEST_SEED replaces it to try other instances.
inline std::uint64_t testSeed() {
  const char* value = std::getenv("HYBRIDGV_TEST_SEED");
  return value ? std::strtoull(value, nullptr, 10) : 20261122;
}

}  // namespace test
}  // namespace hybridgv
