// What the images of a map see, as viewing rays; and which points of the map are certain.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "Triangulation.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// "model.images[3]", for messages.
std::string modelElement(const char* list, std::size_t index);

// All of these throw std::invalid_argument for indices out of range and numbers that are not finite.
const Camera& cameraOf(const SparseModel& model, std::size_t image);
void checkPose(const SparseModel& model, std::size_t image);
void checkObservation(std::size_t image, const Observation& o);

// What a map image sees: its image point, or, if its camera is no distorted pinhole, the centre of the image of a pinhole camera
// that is turned towards the ray. Distances in that image are pixels of the map image on its axis.
struct MapRay {
  View view;
  Eigen::Vector3d bearing;  // in the map image's frame
};

// Empty if the observation is the image of nothing.
std::optional<MapRay> mapRay(const SparseModel& model, std::size_t imageIndex, const Observation& o);

// What makes a point certain.
struct PointLimits {
  double minParallax;  // [rad]
  double maxErrorPx;
};

// The position of a point, if it is certain: that of the map, or, without the image `withheld` (kNoImage: none), of the rays of the
// others.
constexpr std::size_t kNoImage = static_cast<std::size_t>(-1);
std::optional<Eigen::Vector3d> certainPosition(const SparseModel& model, std::size_t point, std::size_t withheld,
                                               const PointLimits& limits);

}  // namespace sfm
}  // namespace hybridgv
