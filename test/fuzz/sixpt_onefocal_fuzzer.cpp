#include "SolverFuzzer.hpp"
#include "hybridgv/relative_pose/methods.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  return fuzz::fuzzSolver(data, size, 6, 0, 9, 0,
                          [](const fuzz::RawAdapter& adapter) { return relative_pose::sixpt_onefocal(adapter); });
}
