// The arrays in COLMAP's databases: what the first bytes say about rows and columns, and a blob.
#include <cstdint>
#include <cstring>

#include "Blobs.hpp"
#include "ReaderFuzzer.hpp"

namespace {

// Small numbers that may fit the blob, or anything.
std::int64_t decodeCount(const std::uint8_t* bytes) {
  std::int64_t value = 0;
  if (bytes[0] % 4 != 0) return bytes[1];
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  constexpr std::size_t kHeader = 17;
  if (size < kHeader) return 0;
  const sfm::BlobShape shape{decodeCount(data + 1), decodeCount(data + 9)};
  const std::string_view blob(reinterpret_cast<const char*>(data + kHeader), size - kHeader);
  std::vector<sfm::Keypoint> keypoints;
  if (sfm::decodeKeypoints(shape, blob, keypoints).empty()) {
    if (keypoints.size() != static_cast<std::size_t>(shape.rows)) fuzz::reportFault("a keypoint for every row");
  } else if (!keypoints.empty()) {
    fuzz::reportFault("no keypoints of a damaged blob");
  }
  std::vector<std::array<std::uint32_t, 2>> pairs, swapped;
  const std::string fault = sfm::decodeMatches(shape, blob, false, pairs);
  if (fault != sfm::decodeMatches(shape, blob, true, swapped)) fuzz::reportFault("both orders are alike");
  if (fault.empty() != (pairs.size() == static_cast<std::size_t>(shape.rows))) fuzz::reportFault("a pair for every row");
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i][0] != swapped[i][1] || pairs[i][1] != swapped[i][0]) fuzz::reportFault("both orders are alike");
  std::vector<double> numbers;
  if (sfm::decodeNumbers(blob, numbers).empty() != (blob.size() % sizeof(double) == 0)) fuzz::reportFault("whole numbers only");
  return 0;
}
