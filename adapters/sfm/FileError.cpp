#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {

FileError::FileError(const std::string& what, const std::string& file, std::size_t line, std::size_t byteOffset)
    : std::runtime_error(what), file_(file), line_(line), byteOffset_(byteOffset) {}

FileError::~FileError() = default;

FileError FileError::inFile(const std::string& file, const std::string& reason) {
  return {file + ": " + reason, file, kNowhere, kNowhere};
}

FileError FileError::atLine(const std::string& file, std::size_t line, const std::string& reason) {
  return {file + ":" + std::to_string(line) + ": " + reason, file, line, kNowhere};
}

FileError FileError::atByte(const std::string& file, std::size_t byteOffset, const std::string& reason) {
  return {file + ": byte " + std::to_string(byteOffset) + ": " + reason, file, kNowhere, byteOffset};
}

}  // namespace sfm
}  // namespace hybridgv
