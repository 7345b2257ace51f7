#include "UnknownModelSizes.hpp"

#include "CameraModels.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Counts = std::map<std::int32_t, std::size_t>;

std::uint64_t littleEndian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i - 1]);
  return value;
}

class Search {
 public:
  explicit Search(std::string_view contents) : contents_(contents) {}

  // Walks from the camera at `position` on, of which `left` are left; sizes that are missing in `counts` are tried.
  bool walk(std::size_t position, std::uint64_t left, Counts& counts) {
    constexpr std::size_t kHeaderBytes = 24, kMostParameters = 32;
    for (; left > 0; --left) {
      if (visits_++ > kMostVisits || contents_.size() - position < kHeaderBytes) return false;
      const auto number = static_cast<std::int32_t>(littleEndian(contents_.substr(position + 4, 4)));
      if (!isSize(position + 8) || !isSize(position + 16)) return false;
      position += kHeaderBytes;
      const CameraModel model = colmapModelFromNumber(number);
      const auto known = counts.find(number);
      if (model == CameraModel::Unknown && known == counts.end()) {
        for (std::size_t count = 0; count <= kMostParameters; ++count) {
          counts[number] = count;
          if (contents_.size() - position >= 8 * count && walk(position + 8 * count, left - 1, counts)) return true;
        }
        counts.erase(number);
        return false;
      }
      const std::size_t bytes = 8 * (model == CameraModel::Unknown ? known->second : parameterCount(model));
      if (contents_.size() - position < bytes) return false;
      position += bytes;
    }
    return position == contents_.size();
  }

 private:
  static constexpr int kMostVisits = 1000000;  // beyond, the file is damaged rather than new

  bool isSize(std::size_t position) const {
    constexpr std::uint64_t kLargest = 100000000;  // [px]
    return littleEndian(contents_.substr(position, 8)) < kLargest;
  }

  std::string_view contents_;
  int visits_ = 0;
};

}  // namespace

bool findUnknownModelSizes(std::string_view contents, std::map<std::int32_t, std::size_t>& parameterCounts) {
  constexpr std::size_t kCountBytes = 8;
  if (contents.size() < kCountBytes) return false;
  return Search(contents).walk(kCountBytes, littleEndian(contents.substr(0, kCountBytes)), parameterCounts);
}

}  // namespace sfm
}  // namespace hybridgv
