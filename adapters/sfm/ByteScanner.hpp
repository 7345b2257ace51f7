// Takes a binary little-endian file apart, and knows the offset when something is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace hybridgv {
namespace sfm {

class ByteScanner {
 public:
  explicit ByteScanner(std::string file);

  // Every `what` names the thing expected, for the error message.
  std::uint8_t byte(const char* what) { return static_cast<std::uint8_t>(unsignedInteger(what, 1)); }
  std::uint32_t u32(const char* what) { return static_cast<std::uint32_t>(unsignedInteger(what, 4)); }
  std::uint64_t u64(const char* what) { return unsignedInteger(what, 8); }
  double number(const char* what);     // finite
  std::string text(const char* what);  // up to a zero byte
  // A number of records that follow and take at least `minBytes` each; checked against what is left of the file.
  std::size_t count(const char* what, std::size_t minBytes);
  // Fails unless the whole file has been read.
  void expectEnd();

  std::size_t offset() const { return position_; }
  const std::string& file() const { return file_; }
  [[noreturn]] void fail(const std::string& reason) const;  // at the thing read last

 private:
  std::uint64_t unsignedInteger(const char* what, std::size_t bytes);

  std::string file_, contents_;
  std::size_t position_ = 0, last_ = 0;
};

}  // namespace sfm
}  // namespace hybridgv
