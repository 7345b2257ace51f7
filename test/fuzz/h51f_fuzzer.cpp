#include "SolverFuzzer.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  return fuzz::fuzzSolver(data, size, 5, 1, 56, 2, [](const fuzz::RawAdapter& adapter) { return hybrid_pose::h51f(adapter); });
}
