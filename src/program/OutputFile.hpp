// A text file that takes its place when it is complete.
#pragma once

#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace program {

class OutputFile {
 public:
  explicit OutputFile(std::string path) : path_(std::move(path)), stream_(path_ + ".tmp", std::ios::binary | std::ios::trunc) {
    check();
  }
  ~OutputFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(path_ + ".tmp", ignored);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const std::string& text) {
    stream_ << text;
    check();
  }
  void commit() {
    stream_.close();
    check();
    std::filesystem::rename(path_ + ".tmp", path_);
    committed_ = true;
  }

 private:
  void check() const {
    if (!stream_) throw std::runtime_error(path_ + ": cannot be written");
  }

  std::string path_;
  std::ofstream stream_;
  bool committed_ = false;
};

// As many digits as are needed to read the same number again.
inline std::string inDigits(double value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, result.ptr};
}

}  // namespace program
