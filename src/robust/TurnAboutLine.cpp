#include "robust/TurnAboutLine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "robust/ApparentDepth.hpp"
#include "robust/PrincipalAxes.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Beyond this there is no need to know more.
constexpr double kSure = 0.02;

// Where a ray or a point of an inlier is; by how much its noise moves it in depth; and the variance of how far it moves it across, in those
// of the image's noise.
struct Place {
  Eigen::Vector3d position, noise;
  double across;
};
using Places = std::vector<Place>;

Places placesOfPoints(const PoseScorer& scorer, const QueryPose& pose) {
  Places places;
  const std::vector<double> errors = scorer.squaredPointErrors(pose);
  const double squared = scorer.thresholds().points * scorer.thresholds().points;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (errors[i] < squared) places.push_back({scorer.arrays().points()[i].point, Eigen::Vector3d::Zero(), 0});
  return places;
}

// Map images are taken to be as noisy as the query, so that the place along the epipolar line has twice the variance of the error across.
Places placesOfRays(const PoseScorer& scorer, const QueryPose& pose, double deviation) {
  constexpr double kAcross = 2;  // along both axes of the image
  Places places;
  const std::vector<double> errors = scorer.squaredRayErrors(pose);
  const double squared = scorer.thresholds().rays * scorer.thresholds().rays;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!(errors[i] < squared)) continue;
    if (const std::optional<ApparentPlace> place = apparentPlace(scorer.arrays().rays()[i], pose))
      places.push_back({place->position, std::sqrt(2.) * deviation * place->perPixel, kAcross});
  }
  return places;
}

struct Line {
  explicit Line(const Places& places) {
    std::vector<Eigen::Vector3d> positions;
    for (const Place& place : places) positions.push_back(place.position);
    const PrincipalAxes axes(positions);
    centre = axes.centre;
    direction = axes.directions.col(2);
  }
  double squaredDistance(const Eigen::Vector3d& offset) const {
    return (offset - direction.dot(offset) * direction).squaredNorm();
  }

  Eigen::Vector3d centre, direction;
};

// What places tell of the turn: the inverse of its variance. As many as are beside the line by chance, those that lie farthest, do not count.
double information(const Places& places, const Line& line, const QueryPose& pose, double deviation, double byChance) {
  constexpr double kAllowance = 1.5;  // linear theory says too little where viewing rays meet at small angles
  std::vector<double> terms;
  double ofNoise = 0;
  for (const Place& place : places) {
    const double perLength = pose.focalLength / pose.rotation.col(2).dot(place.position - pose.position) / deviation;
    const double squared = line.squaredDistance(place.position - line.centre) * perLength * perLength;
    const double noise = kAllowance * (line.squaredDistance(place.noise) * perLength * perLength + place.across);
    if (!std::isfinite(squared - noise)) continue;
    terms.push_back(squared - noise);
    ofNoise += 2 * noise * noise;
  }
  std::sort(terms.begin(), terms.end());
  const auto left = static_cast<std::size_t>(std::max(static_cast<double>(terms.size()) - byChance, 0.));
  double sum = -3 * std::sqrt(ofNoise);
  for (std::size_t i = 0; i < left; ++i) sum += terms[i];
  return std::max(sum, 0.);
}

}  // namespace

double deviationOfTurn(const PoseScorer& scorer, const QueryPose& pose, double pointDeviation, const RayNoise& rayNoise) {
  constexpr std::size_t kEnough = 3;
  const Places points = placesOfPoints(scorer, pose);
  double sum = 0;
  if (points.size() >= kEnough) sum = information(points, Line(points), pose, pointDeviation, 0);
  if (sum * kSure * kSure > 1) return 1 / std::sqrt(sum);
  // Beside a line, a wrong pose can have rays that seem less noisy than they are.
  const double deviation = points.size() >= kEnough ? std::max(rayNoise.deviation, pointDeviation) : rayNoise.deviation;
  const Places rays = placesOfRays(scorer, pose, deviation);
  if (!rays.empty())
    sum += information(rays, Line(points.size() >= kEnough ? points : rays), pose, deviation, 2 * rayNoise.byChance + 1);
  return sum > 0 ? 1 / std::sqrt(sum) : std::numeric_limits<double>::infinity();
}

}  // namespace robust
}  // namespace hybridgv
