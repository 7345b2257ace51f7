#include "Blobs.hpp"

#include <cstring>

namespace hybridgv {
namespace sfm {
namespace {

template <class Unsigned>
Unsigned littleEndian(const char* bytes) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof value; ++i) value |= static_cast<Unsigned>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return value;
}

template <class Number, class Unsigned>
Number number(const char* bytes) {
  static_assert(sizeof(Number) == sizeof(Unsigned));
  const Unsigned bits = littleEndian<Unsigned>(bytes);
  Number value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

constexpr std::size_t kCell = 4;  // bytes of a float32 or uint32

// Empty, or what is wrong. No product can overflow.
std::string findFault(const BlobShape& shape, std::string_view blob) {
  const auto cells = static_cast<std::int64_t>(blob.size() / kCell);
  const bool fits = blob.size() % kCell == 0 && shape.rows >= 0 && shape.columns > 0 && cells % shape.columns == 0 &&
                    cells / shape.columns == shape.rows;
  if (fits) return {};
  return std::to_string(shape.rows) + " rows of " + std::to_string(shape.columns) + " columns do not make " +
         std::to_string(blob.size()) + " bytes";
}

}  // namespace

std::string decodeKeypoints(const BlobShape& shape, std::string_view blob, std::vector<Keypoint>& keypoints) {
  keypoints.clear();
  if (shape.rows == 0 && blob.empty()) return {};
  const std::string fault = findFault(shape, blob);
  if (!fault.empty()) return fault;
  if (shape.columns < 2) return "keypoints have " + std::to_string(shape.columns) + " columns";
  const std::size_t stride = kCell * static_cast<std::size_t>(shape.columns);
  keypoints.reserve(static_cast<std::size_t>(shape.rows));
  for (std::size_t at = 0; at < blob.size(); at += stride)
    keypoints.push_back({number<float, std::uint32_t>(blob.data() + at), number<float, std::uint32_t>(blob.data() + at + kCell)});
  return {};
}

std::string decodeMatches(const BlobShape& shape, std::string_view blob, bool isSwapped,
                          std::vector<std::array<std::uint32_t, 2>>& pairs) {
  pairs.clear();
  if (shape.rows == 0) return {};
  const std::string fault = findFault(shape, blob);
  if (!fault.empty()) return fault;
  if (shape.columns != 2) return "matches have " + std::to_string(shape.columns) + " columns";
  pairs.reserve(static_cast<std::size_t>(shape.rows));
  for (std::size_t at = 0; at < blob.size(); at += 2 * kCell) {
    const auto first = littleEndian<std::uint32_t>(blob.data() + at),
               second = littleEndian<std::uint32_t>(blob.data() + at + kCell);
    pairs.push_back(isSwapped ? std::array<std::uint32_t, 2>{second, first} : std::array<std::uint32_t, 2>{first, second});
  }
  return {};
}

std::string decodeNumbers(std::string_view blob, std::vector<double>& numbers) {
  numbers.clear();
  if (blob.size() % sizeof(double) != 0) return std::to_string(blob.size()) + " bytes are no list of numbers";
  for (std::size_t at = 0; at < blob.size(); at += sizeof(double))
    numbers.push_back(number<double, std::uint64_t>(blob.data() + at));
  return {};
}

}  // namespace sfm
}  // namespace hybridgv
