// Little-endian binary data.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace hybridgv {
namespace sfm {

inline void putInteger(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
}

inline void putNumber(std::string& bytes, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  putInteger(bytes, bits, 8);
}

}  // namespace sfm
}  // namespace hybridgv
