#include "robust/LookAlikes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "robust/ApparentDepth.hpp"
#include "robust/PrincipalAxes.hpp"
#include "robust/medians.hpp"

namespace hybridgv {
namespace robust {
namespace {

using Positions = std::vector<Eigen::Vector3d>;

Positions inlierPoints(const PoseScorer& scorer, const std::vector<double>& squaredErrors) {
  Positions positions;
  const double squared = scorer.thresholds().points * scorer.thresholds().points;
  for (std::size_t i = 0; i < squaredErrors.size(); ++i)
    if (squaredErrors[i] < squared) positions.push_back(scorer.arrays().points()[i].point);
  return positions;
}

// Of the inlier rays, the half that noise moves least.
void addInlierRays(const PoseScorer& scorer, const std::vector<double>& squaredErrors, const QueryPose& pose,
                   Positions& positions) {
  const double squared = scorer.thresholds().rays * scorer.thresholds().rays;
  std::vector<ApparentPlace> places;
  for (std::size_t i = 0; i < squaredErrors.size(); ++i) {
    if (!(squaredErrors[i] < squared)) continue;
    if (const std::optional<ApparentPlace> place = apparentPlace(scorer.arrays().rays()[i], pose)) places.push_back(*place);
  }
  std::sort(places.begin(), places.end(),
            [](const ApparentPlace& a, const ApparentPlace& b) { return a.perPixel.squaredNorm() < b.perPixel.squaredNorm(); });
  for (std::size_t i = 0; i < (places.size() + 1) / 2; ++i) positions.push_back(places[i].position);
}

Eigen::Matrix3d reflection(const Eigen::Vector3d& axis) { return Eigen::Matrix3d::Identity() - 2 * axis * axis.transpose(); }

// Q^T for the plane with this normal; none if it is seen at a right angle, where that is the identity.
std::optional<Eigen::Matrix3d> mirroring(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction) {
  constexpr double kLeastAngle = 1e-3;
  if (!(normal.cross(direction).norm() > kLeastAngle)) return std::nullopt;
  return reflection(normal) * reflection(direction);
}

// What turns the query about the centre. `largestError` [px]: what lies beside the plane or the line changes sides, by which errors may become
// as large.
class Turns {
 public:
  Turns(const PrincipalAxes& axes, const QueryPose& pose, double largestError)
      : axes_(axes.directions), deviations_(axes.deviations), offset_(axes.centre - pose.position) {
    isValid_ = axes_.allFinite() && deviations_[2] > 0;
    largestDeviation_ = largestError / 2 * offset_.norm() / pose.focalLength;
  }

  std::vector<Eigen::Matrix3d> mirrored() const {
    const Eigen::Vector3d normal = axes_.col(0);
    const std::optional<Eigen::Matrix3d> turn = mirroring(normal, direction());
    const bool isFlat = isValid_ && deviations_[0] * normal.cross(direction()).norm() < largestDeviation_;
    return isFlat && turn ? std::vector<Eigen::Matrix3d>{*turn} : std::vector<Eigen::Matrix3d>();
  }
  std::vector<Eigen::Matrix3d> turned() const {
    constexpr int kTurns = 8;
    std::vector<Eigen::Matrix3d> turns;
    if (!isValid_ || !(deviations_[1] < largestDeviation_)) return turns;
    const Eigen::Vector3d line = axes_.col(2), across = line.cross(direction()).cross(line);
    const std::optional<Eigen::Matrix3d> mirrored = mirroring(across.normalized(), direction());
    for (int k = 0; k < kTurns; ++k) {
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(k * 2 * static_cast<double>(EIGEN_PI) / kTurns, line).toRotationMatrix();
      if (k > 0) turns.push_back(turn);
      if (mirrored) turns.push_back(turn * *mirrored);
    }
    return turns;
  }

 private:
  Eigen::Vector3d direction() const { return offset_.normalized(); }

  Eigen::Matrix3d axes_;
  Eigen::Vector3d deviations_, offset_;
  bool isValid_;
  double largestDeviation_;
};

}  // namespace

LookAlikes lookAlikes(const PoseScorer& scorer, const QueryPose& pose) {
  constexpr std::size_t kEnoughPoints = 6, kFewest = 3;
  const std::vector<double> points = scorer.squaredPointErrors(pose), rays = scorer.squaredRayErrors(pose);
  Positions positions = inlierPoints(scorer, points);
  if (positions.size() < kEnoughPoints) addInlierRays(scorer, rays, pose, positions);
  if (positions.size() < kFewest) return {};
  const std::size_t inliers = countBelow(points, scorer.thresholds().points) + countBelow(rays, scorer.thresholds().rays);
  const PrincipalAxes axes(positions);
  const auto posesAt = [&](const std::vector<Eigen::Matrix3d>& turns) {
    std::vector<QueryPose> poses;
    for (const Eigen::Matrix3d& turn : turns) {
      QueryPose other = pose;
      other.rotation = turn * pose.rotation;
      other.position = axes.centre + turn * (pose.position - axes.centre);
      const std::size_t near = countBelow(scorer.squaredPointErrors(other), scorer.bounds().points) +
                               countBelow(scorer.squaredRayErrors(other), scorer.bounds().rays);
      if (2 * near > inliers) poses.push_back(other);
    }
    return poses;
  };
  const Turns turns(axes, pose, std::max(scorer.bounds().points, scorer.bounds().rays));
  return {posesAt(turns.mirrored()), posesAt(turns.turned())};
}

}  // namespace robust
}  // namespace hybridgv
