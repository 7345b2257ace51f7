#include "robust/RaySlope.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "robust/ApparentDepth.hpp"
#include "robust/ChosenArrays.hpp"
#include "robust/InverseDepths.hpp"
#include "robust/KernelRows.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Map images are taken to be as noisy as the query, so that the place along the line has twice the variance of its error across.
constexpr double kVariancesAlong = 2;

bool isInlier(double squaredError, const KindLoss& loss) { return squaredError < loss.scale * loss.scale; }

Members inlierRays(const LeastSquaresProblem& problem, const PlainPose& pose) {
  const RayArrays& rays = problem.rays;
  std::vector<double> errors(correspondences::padded(rays.size));
  problem.kernels->squaredRayErrorsBeyondInfinity(rays, pose, errors.data());
  Members result;
  for (std::size_t i = 0; i < rays.size; ++i)
    if (isInlier(rays.narrowing ? *(rays.narrowing + i) * errors[i] : errors[i], problem.rayLoss)) result.push_back(i);
  return result;
}

void add(double inverseDepth, double variance, InverseDepths& depths) {
  depths.values.push_back(inverseDepth);
  depths.variances.push_back(variance);
}

// Of these rays; those without one, where the query is in the rig camera, are taken out of the list.
InverseDepths inverseDepthsOf(Members& rays, const CorrespondenceArrays& arrays, const QueryPose& pose, double variance) {
  InverseDepths depths;
  depths.values.reserve(rays.size() + arrays.points().size());
  depths.variances.reserve(rays.size() + arrays.points().size());
  Members kept;
  kept.reserve(rays.size());
  for (const std::size_t i : rays) {
    const ApparentDepth depth = apparentDepth(arrays.rays()[i], pose);
    const double ofError = variance * depth.perPixel * depth.perPixel;
    if (!std::isfinite(depth.inverse) || !std::isfinite(ofError)) continue;
    add(depth.inverse, ofError, depths);
    kept.push_back(i);
  }
  rays = std::move(kept);
  return depths;
}

// Points are taken to be exact.
void addInlierPoints(const LeastSquaresProblem& problem, const PlainPose& plain, const QueryPose& pose, InverseDepths& depths) {
  const PointArrays& points = problem.points;
  std::vector<double> errors(correspondences::padded(points.size));
  problem.kernels->squaredPointErrors(points, plain, errors.data());
  for (std::size_t i = 0; i < points.size; ++i) {
    if (!isInlier(errors[i], problem.pointLoss)) continue;
    const Eigen::Vector3d point(points.x[i], points.y[i], points.z[i]);
    const double inverse = 1 / pose.rotation.col(2).dot(point - pose.position);
    if (std::isfinite(inverse)) add(inverse, 0, depths);
  }
}

// The trust in the rays' depths. A wrong ray that is an inlier by chance lies anywhere. So those that are not where the scene is are right
// only as far as there are more of them than that; twice the number, because it scatters.
std::vector<double> trustsIn(const InverseDepths& depths, std::size_t rays, const DepthDistribution& scene, double byChance) {
  std::vector<double> trusts(rays);
  int few = 0;
  for (std::size_t i = 0; i < rays; ++i) few += scene.isOneOfFew(depths.values[i], depths.variances[i]);
  const double right = std::max(1 - 2 * byChance / std::max(few, 1), 0.);
  for (std::size_t i = 0; i < rays; ++i)
    trusts[i] = scene.trust(depths.values[i], depths.variances[i]) *
                (scene.isOneOfFew(depths.values[i], depths.variances[i]) ? right : 1);
  return trusts;
}

// Whether so little of what rays say is noise that nothing changes.
bool areSharp(const InverseDepths& depths, std::size_t rays) {
  constexpr double kLittle = 0.02;
  const double variance = roughDepthDistribution(depths).variance;
  double noise = 0;
  for (std::size_t i = 0; i < rays; ++i) noise += depths.variances[i] / (depths.variances[i] + variance);
  return noise <= kLittle * static_cast<double>(rays);
}

// Places in the image of some rays.
struct Places {
  explicit Places(std::size_t size) : u(correspondences::padded(size)), v(correspondences::padded(size)) {}
  void set(std::size_t i, const Eigen::Vector2d& place) {
    u[i] = place.x();
    v[i] = place.y();
  }

  std::vector<double> u, v;
};

// The first ones tell as much as many, because correspondences are in random order.
bool seemSharp(const LeastSquaresProblem& inliers, Members rays, const CorrespondenceArrays& arrays, const QueryPose& pose,
               double variance) {
  constexpr std::size_t kEnough = 1000;
  if (rays.size() <= kEnough) return false;
  rays.resize(kEnough);
  LeastSquaresProblem some = inliers;
  some.points.size = std::min(some.points.size, kEnough);
  InverseDepths depths = inverseDepthsOf(rays, arrays, pose, variance);
  if (some.kinds.points) addInlierPoints(some, toPlain(pose), pose, depths);
  return areSharp(depths, rays.size());
}

// Where rays would be seen at their likely depths, and a step beside that along their epipolar lines. Where one is not seen there, it stays
// where it is, and the step is 0.
struct LikelyPlaces {
  explicit LikelyPlaces(std::size_t size) : here(size), beside(size), steps(size, 0) {}

  Places here, beside;
  std::vector<double> steps;
};

LikelyPlaces likelyPlaces(const CorrespondenceArrays& arrays, const Members& rays, const QueryPose& pose,
                          const InverseDepths& depths, double mean, const std::vector<double>& trusts) {
  constexpr double kStep = 0.01;  // in standard deviations
  LikelyPlaces places(rays.size());
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const correspondences::RayMatch& ray = arrays.rays()[rays[k]];
    const double likely = mean + trusts[k] * (depths.values[k] - mean);
    const std::optional<Eigen::Vector2d> here = movedToDepth(ray, pose, likely);
    const std::optional<Eigen::Vector2d> beside = movedToDepth(ray, pose, likely + kStep * std::sqrt(depths.variances[k]));
    const Eigen::Vector2d seen(ray.u, ray.v);
    places.here.set(k, here && beside ? *here : seen);
    places.beside.set(k, here && beside ? *beside : seen);
    places.steps[k] = here && beside ? (*beside - *here).norm() : 0;
  }
  return places;
}

KernelRows rowsAt(const LeastSquaresProblem& problem, RayArrays rays, const Places& places, const PlainPose& pose) {
  rays.u = places.u.data();
  rays.v = places.v.data();
  rays.narrowing = {};
  KernelRows rows(rays.size, kRayRow);
  problem.kernels->rayRows(rays, pose, {Loss::Quadratic, 1, 1}, rows.data());
  return rows;
}

// `variance`: of the places along the lines.
RaySlope sumsAt(const LikelyPlaces& places, const LeastSquaresProblem& problem, const RayArrays& rays, const PlainPose& pose,
                const std::vector<double>& trusts, double variance) {
  const KernelRows here = rowsAt(problem, rays, places.here, pose), beside = rowsAt(problem, rays, places.beside, pose);
  FullParameterMatrix slope = FullParameterMatrix::Zero(), noise = FullParameterMatrix::Zero();
  for (std::size_t k = 0; k < rays.size; ++k) {
    const FullParameterVector J = here.derivatives(k, kFirstDerivative);
    if (!(here.weight(k) > 0) || !J.allFinite()) continue;
    slope.noalias() += J * J.transpose();
    const FullParameterVector change = (beside.derivatives(k, kFirstDerivative) - J) / places.steps[k];
    if (!(beside.weight(k) > 0) || !change.allFinite()) continue;
    const FullParameterMatrix ofNoise = variance * change * change.transpose();
    slope += trusts[k] * ofNoise;
    noise += ofNoise;
  }
  const double weight = problem.rayLoss.precision;
  return {estimatedPart(weight * slope, problem.estimated), estimatedPart(weight * (slope + noise), problem.estimated)};
}

}  // namespace

std::optional<RaySlope> raySlope(const LeastSquaresProblem& inliers, const CorrespondenceArrays& arrays, const QueryPose& pose,
                                 const RayNoise& noise) {
  if (!inliers.kinds.rays) return std::nullopt;
  const PlainPose plain = toPlain(pose);
  Members rays = inlierRays(inliers, plain);
  const double variance = kVariancesAlong * noise.deviation * noise.deviation;
  if (seemSharp(inliers, rays, arrays, pose, variance)) return std::nullopt;
  InverseDepths depths = inverseDepthsOf(rays, arrays, pose, variance);
  if (rays.empty()) return std::nullopt;
  if (inliers.kinds.points) addInlierPoints(inliers, plain, pose, depths);
  if (areSharp(depths, rays.size())) return std::nullopt;
  const DepthDistribution scene = depthDistribution(depths);
  const std::vector<double> trusts = trustsIn(depths, rays.size(), scene, noise.byChance);
  const LikelyPlaces places = likelyPlaces(arrays, rays, pose, depths, scene.mean, trusts);
  ChosenArrays chosen;
  return sumsAt(places, inliers, chosen.rays(inliers.rays, rays), plain, trusts, variance);
}

bool covarianceBySlope(const ParameterMatrix& others, const RaySlope& rays, double weight, ParameterMatrix& covariance) {
  ParameterMatrix inverse;
  if (!invertInformation(others + weight * rays.slope, inverse)) return false;
  covariance = inverse * (others + weight * weight * rays.scatter) * inverse;
  return covariance.allFinite();
}

// Of the focal length; if it is known, of the position.
static double varianceToReduce(const ParameterMatrix& covariance, Intrinsics estimated) {
  return estimated.focalLength ? varianceOfLogFocalLength(covariance, estimated) : covariance.diagonal().segment<3>(3).sum();
}

double bestWeight(const ParameterMatrix& others, const RaySlope& rays, Intrinsics estimated) {
  constexpr double kLeast = 1e-3, kClearGain = 0.7;
  double best = 1, least = 0, ofOne = 0;
  for (double weight = 1; weight > kLeast; weight /= 2) {
    ParameterMatrix covariance;
    if (!covarianceBySlope(others, rays, weight, covariance)) break;
    const double variance = varianceToReduce(covariance, estimated);
    if (weight == 1) least = ofOne = variance;
    if (!(variance < least)) continue;
    least = variance;
    best = weight;
  }
  return least < kClearGain * ofOne ? best : 1;
}

}  // namespace robust
}  // namespace hybridgv
