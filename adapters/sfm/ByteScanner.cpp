#include "ByteScanner.hpp"

#include <cmath>
#include <cstring>

#include "FileContents.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {

ByteScanner::ByteScanner(std::string file) : file_(std::move(file)), contents_(readFile(file_)) {}

void ByteScanner::fail(const std::string& reason) const { throw FileError::atByte(file_, last_, reason); }

std::uint64_t ByteScanner::unsignedInteger(const char* what, std::size_t bytes) {
  last_ = position_;
  if (contents_.size() - position_ < bytes) fail(std::string("the file ends where ") + what + " is expected");
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(contents_[position_ + i])) << (8 * i);
  position_ += bytes;
  return value;
}

double ByteScanner::number(const char* what) {
  static_assert(sizeof(double) == sizeof(std::uint64_t));
  const std::uint64_t bits = u64(what);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  if (!std::isfinite(value)) fail(std::string(what) + " is not finite");
  return value;
}

std::string ByteScanner::text(const char* what) {
  last_ = position_;
  const std::size_t end = contents_.find('\0', position_);
  if (end == std::string::npos) fail(std::string("the file ends in ") + what);
  position_ = end + 1;
  return contents_.substr(last_, end - last_);
}

std::size_t ByteScanner::count(const char* what, std::size_t minBytes) {
  const std::uint64_t value = u64(what);
  if (value > (contents_.size() - position_) / minBytes)
    fail(std::string(what) + ": " + std::to_string(value) + " do not fit into the rest of the file");
  return static_cast<std::size_t>(value);
}

void ByteScanner::expectEnd() {
  last_ = position_;
  if (position_ != contents_.size()) fail(std::to_string(contents_.size() - position_) + " bytes after the end of the data");
}

}  // namespace sfm
}  // namespace hybridgv
