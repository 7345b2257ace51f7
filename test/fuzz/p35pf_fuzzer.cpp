#include "SolverFuzzer.hpp"
#include "hybridgv/absolute_pose/methods.hpp"

// The fourth point satisfies the equation of u only.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  return fuzz::fuzzSolver(data, size, 0, 4, 10, 7, [](const fuzz::RawAdapter& adapter) { return absolute_pose::p35pf(adapter); });
}
