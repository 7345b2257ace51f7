#include "ReaderFuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  fuzz::writeColmapFiles(data, size, ".txt");
  return fuzz::fuzzModelReader(fuzz::folder().path(), sfm::readColmapText);
}
