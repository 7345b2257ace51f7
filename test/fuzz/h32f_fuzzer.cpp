#include "SolverFuzzer.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  return fuzz::fuzzSolver(data, size, 3, 2, 26, 4, [](const fuzz::RawAdapter& adapter) { return hybrid_pose::h32f(adapter); });
}
