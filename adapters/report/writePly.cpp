#include <cstring>

#include "../sfm/FileContents.hpp"
#include "Frustum.hpp"
#include "hybridgv/adapters/report/Page.hpp"

namespace hybridgv {
namespace report {
namespace {

using Colour = std::array<std::uint8_t, 3>;

// The vertices of a binary PLY file.
class Vertices {
 public:
  void add(const Eigen::Vector3d& place, const Colour& colour) {
    if (!place.allFinite()) return;
    for (Eigen::Index k = 0; k < 3; ++k) {
      char bytes[sizeof(double)];
      std::memcpy(bytes, &place[k], sizeof bytes);
      bytes_.append(bytes, sizeof bytes);
    }
    for (const std::uint8_t value : colour) bytes_ += static_cast<char>(value);
    ++count_;
  }
  void addEdge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Colour& colour) {
    constexpr int kSteps = 30;
    for (int i = 0; i <= kSteps; ++i) add(from + static_cast<double>(i) / kSteps * (to - from), colour);
  }
  void add(const Frustum& frustum, const Colour& colour) {
    for (std::size_t i = 0; i < frustum.corners.size(); ++i) {
      addEdge(frustum.centre, frustum.corners[i], colour);
      addEdge(frustum.corners[i], frustum.corners[(i + 1) % frustum.corners.size()], colour);
    }
  }
  std::string file() const {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count_) +
           "\nproperty double x\nproperty double y\nproperty double z\n"
           "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n" +
           bytes_;
  }

 private:
  std::string bytes_;
  std::size_t count_ = 0;
};

}  // namespace

void writePly(const std::string& path, const sfm::SparseModel& map, const std::vector<ReportedImage>& images) {
  constexpr double kFrustumDepth = 0.1;  // of the scene's radius
  constexpr Colour kBlue{60, 120, 230}, kRed{230, 40, 40};
  const double depth = kFrustumDepth * extentOf(map, images).radius;
  Vertices vertices;
  for (const sfm::Point& point : map.points) vertices.add(point.position, point.colour);
  for (const Frustum& frustum : frustaOf(map, depth)) vertices.add(frustum, kBlue);
  for (const ReportedImage& image : images)
    if (image.success) vertices.add(frustumOf(image, depth), kRed);
  sfm::replaceFile(path, vertices.file());
}

}  // namespace report
}  // namespace hybridgv
