// The arrays inside a COLMAP database: little endian, row by row. Each decoder returns what is wrong, or an empty text.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hybridgv/adapters/sfm/QueryImage.hpp"

namespace hybridgv {
namespace sfm {

// Matrices as their rows and columns and a blob say.
struct BlobShape {
  std::int64_t rows, columns;
};

// float32, of which the first two columns count.
std::string decodeKeypoints(const BlobShape& shape, std::string_view blob, std::vector<Keypoint>& keypoints);

// uint32, two columns; `isSwapped` gives the second column first. No rows: any blob.
std::string decodeMatches(const BlobShape& shape, std::string_view blob, bool isSwapped,
                          std::vector<std::array<std::uint32_t, 2>>& pairs);

// float64
std::string decodeNumbers(std::string_view blob, std::vector<double>& numbers);

}  // namespace sfm
}  // namespace hybridgv
