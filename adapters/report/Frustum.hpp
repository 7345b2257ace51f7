// Cameras as they are drawn.
#pragma once

#include <array>
#include <vector>

#include "hybridgv/adapters/report/Page.hpp"

namespace hybridgv {
namespace report {

// A camera in the map's frame.
struct Frustum {
  Eigen::Vector3d centre;
  std::array<Eigen::Vector3d, 4> corners;  // where its viewing rays end
};

// Where the map is, and how large: without the few points that are far away from all others.
struct Extent {
  Eigen::Vector3d centre;
  double radius = 1;
};

// Of the finite points and of the cameras.
Extent extentOf(const sfm::SparseModel& map, const std::vector<ReportedImage>& images);

// Rays end at the depth `depth`. std::invalid_argument for a pose that is not finite.
Frustum frustumOf(const ReportedImage& image, double depth);

// Of the images that have a pose. A camera of unknown size is drawn as large as its observations need.
std::vector<Frustum> frustaOf(const sfm::SparseModel& map, double depth);

}  // namespace report
}  // namespace hybridgv
