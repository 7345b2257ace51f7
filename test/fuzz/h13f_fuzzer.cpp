#include "SolverFuzzer.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  return fuzz::fuzzSolver(data, size, 1, 3, 12, 6, [](const fuzz::RawAdapter& adapter) { return hybrid_pose::h13f(adapter); });
}
