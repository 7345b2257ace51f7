// Random numbers that are the same with every compiler and standard library.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hybridgv {
namespace math {

// splitmix64 (Steele, Lea, Flood 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t state) : state_(state) {}

  std::uint64_t next() { return mix(state_ += kStep); }
  // [0, 1)
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // 0 .. count-1, count > 0. The bias is below count * 2^-64.
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }

 protected:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

// Random numbers by counter: each hypothesis has its own stream, whatever thread tries it. It starts at a place that depends on the
// seed and the stream's number.
class RandomStream : public SplitMix64 {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : SplitMix64(mix(mix(seed + kStep) ^ mix(~stream))) {}
};

}  // namespace math
}  // namespace hybridgv
