#include "ByteScanner.hpp"

#include <cmath>

#include "FileContents.hpp"

namespace hybridgv {
namespace sfm {

ByteScanner::ByteScanner(std::string file, Mending& mending)
    : file_(std::move(file)), contents_(readFile(file_)), mending_(mending) {}

void ByteScanner::fail(const std::string& reason) const { throw error(reason); }

void ByteScanner::failAtEnd(const char* what) const { fail(std::string("the file ends where ") + what + " is expected"); }

double ByteScanner::number(const char* what) {
  const double value = anyNumber(what);
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
  expectRoom(what, value, minBytes);
  return static_cast<std::size_t>(value);
}

void ByteScanner::expectRoom(const char* what, std::uint64_t count, std::size_t minBytes) const {
  if (count > (contents_.size() - position_) / minBytes)
    fail(std::string(what) + ": " + std::to_string(count) + " do not fit into the rest of the file");
}

void ByteScanner::expectEnd() {
  last_ = position_;
  if (position_ != contents_.size()) fail(std::to_string(contents_.size() - position_) + " bytes after the end of the data");
}

}  // namespace sfm
}  // namespace hybridgv
