/// \file
/// \brief What the readers throw.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// A file that cannot be read, with the place where it went wrong. what() is "FILE:LINE: reason" or "FILE: byte OFFSET: reason".
class HYBRIDGV_EXPORT FileError : public std::runtime_error {
 public:
  /// No line, no byte offset.
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  /// An error of the file as a whole (it is missing, it cannot be written).
  static FileError inFile(const std::string& file, const std::string& reason);
  /// An error in a line of a text file.
  static FileError atLine(const std::string& file, std::size_t line, const std::string& reason);
  /// An error at a place of a binary file.
  static FileError atByte(const std::string& file, std::size_t byteOffset, const std::string& reason);
  FileError(const FileError&) = default;
  FileError& operator=(const FileError&) = default;
  ~FileError() override;

  /// The file's path.
  const std::string& file() const { return file_; }
  /// Line counted from 1 (text files), or kNowhere.
  std::size_t line() const { return line_; }
  /// Offset from the start of the file (binary files), or kNowhere.
  std::size_t byteOffset() const { return byteOffset_; }

 private:
  FileError(const std::string& what, const std::string& file, std::size_t line, std::size_t byteOffset);
  std::string file_;
  std::size_t line_, byteOffset_;
};

}  // namespace sfm
}  // namespace hybridgv
