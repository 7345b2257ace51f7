// Takes a binary little-endian file apart, and knows the offset when something is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "Mending.hpp"

namespace hybridgv {
namespace sfm {

class ByteScanner {
 public:
  ByteScanner(std::string file, Mending& mending);

  // Every `what` names the thing expected, for the error message.
  std::uint8_t byte(const char* what) { return static_cast<std::uint8_t>(unsignedInteger<1>(what)); }
  std::uint32_t u32(const char* what) { return static_cast<std::uint32_t>(unsignedInteger<4>(what)); }
  std::uint64_t u64(const char* what) { return unsignedInteger<8>(what); }
  double number(const char* what);      // finite
  double anyNumber(const char* what) {  // NaN and infinite too
    static_assert(sizeof(double) == sizeof(std::uint64_t));
    const std::uint64_t bits = u64(what);
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::string text(const char* what);  // up to a zero byte
  // A number of records that follow and take at least `minBytes` each; checked against what is left of the file.
  std::size_t count(const char* what, std::size_t minBytes);
  // Fails unless `count` records of `minBytes` each may follow.
  void expectRoom(const char* what, std::uint64_t count, std::size_t minBytes) const;
  // Fails unless the whole file has been read.
  void expectEnd();

  std::size_t offset() const { return position_; }
  const std::string& contents() const { return contents_; }
  const std::string& file() const { return file_; }
  Mending& mending() const { return mending_; }
  // At the thing read last.
  FileError error(const std::string& reason) const { return FileError::atByte(file_, last_, reason); }
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  template <std::size_t kBytes>
  std::uint64_t unsignedInteger(const char* what) {
    last_ = position_;
    if (contents_.size() - position_ < kBytes) failAtEnd(what);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < kBytes; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(contents_[position_ + i])) << (8 * i);
    position_ += kBytes;
    return value;
  }
  [[noreturn]] void failAtEnd(const char* what) const;

  std::string file_, contents_;
  Mending& mending_;
  std::size_t position_ = 0, last_ = 0;
};

}  // namespace sfm
}  // namespace hybridgv
