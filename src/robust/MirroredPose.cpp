#include "robust/MirroredPose.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "robust/ApparentDepth.hpp"

namespace hybridgv {
namespace robust {
namespace {

using Positions = std::vector<Eigen::Vector3d>;

std::size_t countBelow(const std::vector<double>& squaredErrors, double threshold) {
  return static_cast<std::size_t>(
      std::count_if(squaredErrors.begin(), squaredErrors.end(), [=](double e) { return e < threshold * threshold; }));
}

Positions inlierPoints(const PoseScorer& scorer, const std::vector<double>& squaredErrors) {
  Positions positions;
  const double squared = scorer.thresholds().points * scorer.thresholds().points;
  for (std::size_t i = 0; i < squaredErrors.size(); ++i)
    if (squaredErrors[i] < squared) positions.push_back(scorer.arrays().points()[i].point);
  return positions;
}

void addInlierRays(const PoseScorer& scorer, const std::vector<double>& squaredErrors, const QueryPose& pose,
                   Positions& positions) {
  const double squared = scorer.thresholds().rays * scorer.thresholds().rays;
  for (std::size_t i = 0; i < squaredErrors.size(); ++i) {
    if (!(squaredErrors[i] < squared)) continue;
    const correspondences::RayMatch& ray = scorer.arrays().rays()[i];
    const double depth = 1 / apparentDepth(ray, pose).inverse;
    const Eigen::Vector3d direction(ray.u / pose.focalLength, ray.v / pose.focalLength, 1);
    const Eigen::Vector3d position = pose.position + depth * (pose.rotation * direction);
    if (depth > 0 && position.allFinite()) positions.push_back(position);
  }
}

// At least three positions. None if by their distances from the plane, which change sides, errors become larger than this.
std::optional<QueryPose> mirroredAt(const Positions& positions, const QueryPose& pose, double largestError) {
  constexpr double kLeastAngle = 1e-3;  // between the plane's normal and the direction in which it is seen
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& position : positions) centre += position;
  centre /= static_cast<double>(positions.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& position : positions) scatter.noalias() += (position - centre) * (position - centre).transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0), direction = (centre - pose.position).normalized();
  const double angle = normal.cross(direction).norm(), distance = (centre - pose.position).norm();
  const double relief = std::sqrt(std::max(solver.eigenvalues()[0], 0.) / static_cast<double>(positions.size()));
  if (!normal.allFinite() || !(angle > kLeastAngle)) return std::nullopt;
  if (!(2 * relief * angle / distance * pose.focalLength < largestError)) return std::nullopt;
  const auto reflection = [](const Eigen::Vector3d& axis) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() - 2 * axis * axis.transpose();
  };
  const Eigen::Matrix3d back = reflection(normal) * reflection(direction);
  QueryPose result = pose;
  result.rotation = back * pose.rotation;
  result.position = centre + back * (pose.position - centre);
  return result;
}

}  // namespace

std::optional<QueryPose> mirroredPose(const PoseScorer& scorer, const QueryPose& pose) {
  constexpr std::size_t kEnoughPoints = 6, kFewest = 3;
  const std::vector<double> points = scorer.squaredPointErrors(pose);
  Positions positions = inlierPoints(scorer, points);
  if (positions.size() < kEnoughPoints) addInlierRays(scorer, scorer.squaredRayErrors(pose), pose, positions);
  if (positions.size() < kFewest) return std::nullopt;
  const std::optional<QueryPose> result = mirroredAt(positions, pose, std::max(scorer.bounds().points, scorer.bounds().rays));
  if (!result) return std::nullopt;
  const std::vector<double> rays = scorer.squaredRayErrors(pose);
  const std::size_t inliers = countBelow(points, scorer.thresholds().points) + countBelow(rays, scorer.thresholds().rays);
  const std::size_t near = countBelow(scorer.squaredPointErrors(*result), scorer.bounds().points) +
                           countBelow(scorer.squaredRayErrors(*result), scorer.bounds().rays);
  return 2 * near > inliers ? result : std::nullopt;
}

}  // namespace robust
}  // namespace hybridgv
