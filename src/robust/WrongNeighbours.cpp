#include "robust/WrongNeighbours.hpp"

#include <algorithm>
#include <cmath>

#include "math/Vec3.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::CorrespondenceArrays;

constexpr double kPi = 3.14159265358979323846;
// So many pairs, and such a part of all, must be left to tell.
constexpr double kEnoughPairs = 32, kEnoughOfAll = 0.25;

struct Place {
  double u, v;
};

// Without distortion, which moves neighbours alike.
Place seenAt(const PlainPose& pose, const Eigen::Vector3d& point) {
  using Vector = math::Vec3<double>;
  const Vector d{point[0] - pose.position[0], point[1] - pose.position[1], point[2] - pose.position[2]};
  const auto along = [&](const double* axis) { return dot(math::broadcastVector<double>(axis), d); };
  const double factor = pose.focalLength / along(pose.r3);
  return {factor * along(pose.r1), factor * along(pose.r2)};
}

// The part of a circle that another one of the same radius covers, by the distance of their centres in diameters.
double overlapOfCircles(double x) { return x < 1 ? 2 / kPi * (std::acos(x) - x * std::sqrt(1 - x * x)) : 0; }

std::vector<double> squaredPointErrors(const CorrespondenceArrays& arrays, const PlainPose& pose) {
  std::vector<double> errors(correspondences::padded(arrays.points().size()));
  kernelsFor(pose).squaredPointErrors(arrays.pointArrays(), pose, errors.data());
  return errors;
}

}  // namespace

LevelShares sharesOfWrongNeighbours(const CorrespondenceArrays& arrays, const std::vector<NeighbourPair>& pairs,
                                    const std::vector<double>& squaredErrors, const PlainPose& pose, double maxReprojectionError,
                                    const LevelShares& ofAll) {
  const std::vector<double> own = squaredPointErrors(arrays, pose);
  LevelShares below{}, possible{};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Place a = seenAt(pose, arrays.points()[pairs[k].point].point),
                b = seenAt(pose, arrays.points()[pairs[k].neighbour].point);
    const double distance = std::hypot(a.u - b.u, a.v - b.v);
    for (std::size_t level = 0; level < kLevels; ++level) {
      const double threshold = thresholdAt(maxReprojectionError, static_cast<int>(level));
      if (own[pairs[k].neighbour] < threshold * threshold) continue;
      below[level] += squaredErrors[k] < threshold * threshold ? 1 : 0;
      possible[level] += 1 - overlapOfCircles(distance / (2 * threshold));
    }
  }
  LevelShares result = ofAll;
  const double enough = std::max(kEnoughPairs, kEnoughOfAll * static_cast<double>(pairs.size()));
  for (std::size_t level = 0; level < kLevels; ++level)
    if (possible[level] > enough) result[level] = std::min(ofAll[level], below[level] / possible[level]);
  return result;
}

}  // namespace robust
}  // namespace hybridgv
