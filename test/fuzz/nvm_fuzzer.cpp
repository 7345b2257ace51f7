#include "ReaderFuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  return fuzz::fuzzModelReader(fuzz::writeFile(data, size), sfm::readNvm);
}
