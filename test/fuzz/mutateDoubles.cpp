// Mutations that make sense for a sample of doubles, beside libFuzzer's own: coordinates become equal, zero, tiny, huge, not
// finite, or change a little, so that degenerate and nearly degenerate samples appear.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "Random.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace {

using hybridgv::test::Random;

double special(Random& random) {
  constexpr double kValues[] = {0., -0., 1., -1., 1e-320, 1e-200, 1e-8, 1e8, 1e150, 1e300};
  constexpr double kNotFinite[] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()};
  if (random.index(40) == 0) return kNotFinite[random.index(2)];
  return kValues[random.index(10)];
}

double changed(double value, double other, Random& random) {
  switch (random.index(7)) {
    case 0:
      return other;
    case 1:
      return -value;
    case 2:
      return special(random);
    case 3:
      return value * (1 + 1e-3 * random.normal());
    case 4:
      return value * (1 + std::pow(10., -random.uniform(3, 16)));
    case 5:
      return other + std::pow(10., -random.uniform(0, 16)) * value;
    default:
      return value * std::pow(10., random.uniform(-4, 4));
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize, unsigned int seed) {
  Random random(seed);
  const int doubles = static_cast<int>(size / sizeof(double));
  if (doubles < 2 || random.index(4) == 0) return LLVMFuzzerMutate(data, size, maxSize);
  // The doubles stand at the end, after the rig cameras of the rays.
  std::uint8_t* first = data + size % sizeof(double);
  const auto load = [&](int i) {
    double value;
    std::memcpy(&value, first + sizeof(double) * static_cast<std::size_t>(i), sizeof(double));
    return value;
  };
  const auto store = [&](int i, double value) {
    std::memcpy(first + sizeof(double) * static_cast<std::size_t>(i), &value, sizeof(double));
  };
  if (random.index(4) == 0) {  // a whole vector
    const int from = random.index(doubles), to = random.index(doubles);
    for (int k = 0; k < 3 && from + k < doubles && to + k < doubles; ++k) store(to + k, load(from + k));
    return size;
  }
  for (int count = 1 + random.index(3); count > 0; --count) {
    const int i = random.index(doubles);
    store(i, changed(load(i), load(random.index(doubles)), random));
  }
  return size;
}
