#include "robust/Jackknife.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "correspondences/arrayParts.hpp"
#include "robust/GroupedArrays.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Without a group that has nearly all the information in some direction, one step says nothing. (Of the square root of what is left.)
constexpr double kLeastRest = 1e-3;

std::size_t numberOf(const std::vector<int>& groups) {
  return groups.empty() ? 0 : static_cast<std::size_t>(*std::max_element(groups.begin(), groups.end())) + 1;
}

// A part of many correspondences of one kind, and what it adds to each group.
template <class Arrays>
struct PartOfGroups {
  Arrays arrays;
  const int* groups;
  std::vector<NormalEquations> sums;
};

// So long that a group has some in each: the sums of few cost as much as those of many.
template <class Arrays>
std::vector<PartOfGroups<Arrays>> partsOf(const Arrays& arrays, const std::vector<int>& groups, bool takePart) {
  constexpr std::size_t kLeast = 2048, kOfGroup = 64;
  std::vector<PartOfGroups<Arrays>> parts;
  if (!takePart) return parts;
  const std::size_t count = numberOf(groups), length = std::max(kLeast, kOfGroup * count);
  for (std::size_t begin = 0; begin < arrays.size; begin += length) {
    const std::size_t end = std::min(begin + length, arrays.size);
    parts.push_back({correspondences::part(arrays, begin, end), groups.data() + begin, std::vector<NormalEquations>(count)});
  }
  return parts;
}

// addGroup(arrays, sums) for the members of each group.
template <class Arrays, class AddGroup>
void addGroups(PartOfGroups<Arrays>& part, AddGroup addGroup) {
  GroupedArrays<Arrays> grouped;
  grouped.set(part.arrays, part.groups, part.sums.size());
  for (std::size_t group = 0; group < part.sums.size(); ++group) addGroup(grouped.of(group), part.sums[group]);
}

template <class Arrays>
void appendSums(const std::vector<PartOfGroups<Arrays>>& parts, std::vector<NormalEquations>& sums) {
  if (parts.empty()) return;
  const std::size_t first = sums.size();
  sums.insert(sums.end(), parts[0].sums.begin(), parts[0].sums.end());
  for (std::size_t p = 1; p < parts.size(); ++p)
    for (std::size_t group = 0; group < parts[p].sums.size(); ++group) add(parts[p].sums[group], sums[first + group]);
}

// The sums of each group: of those of rays, then of those of points.
std::vector<NormalEquations> sumsOfGroups(const LeastSquaresProblem& problem, const QueryPose& pose,
                                          const JackknifeGroups& groups) {
  const PlainPose plain = toPlain(pose);
  auto rays = partsOf(problem.rays, groups.rays, problem.kinds.rays);
  auto points = partsOf(problem.points, groups.points, problem.kinds.points);
  const auto addRays = [&](const RayArrays& ofGroup, NormalEquations& sums) {
    problem.kernels->addRays(ofGroup, plain, problem.rayLoss, sums);
  };
  const auto addPoints = [&](const PointArrays& ofGroup, NormalEquations& sums) {
    problem.kernels->addPoints(ofGroup, plain, problem.pointLoss, sums);
  };
  forAll(problem.workers, rays.size() + points.size(), [&](std::size_t part) {
    if (part < rays.size())
      addGroups(rays[part], addRays);
    else
      addGroups(points[part - rays.size()], addPoints);
  });
  std::vector<NormalEquations> sums;
  appendSums(rays, sums);
  appendSums(points, sums);
  return sums;
}

// The changes of the pose without each group.
class Changes {
 public:
  // `covariance`: the inverse of the information of all. `gradient`: of all.
  Changes(const FullParameterMatrix& covariance, const FullParameterVector& gradient)
      : covariance_(covariance), root_(covariance.llt().matrixL()), fromMinimum_(covariance * gradient) {}

  void add(const NormalEquations& group, Intrinsics estimated) {
    const int size = estimated.parameters();
    FullParameterMatrix information = FullParameterMatrix::Zero();
    information.topLeftCorner(size, size) = estimatedPart(group, estimated);
    const double part = covariance_.cwiseProduct(information).sum();  // of the information, at most `size`
    if (!(part > 0)) return;                                          // no inliers
    FullParameterVector gradient = FullParameterVector::Zero();
    gradient.head(size) = estimatedGradient(group, estimated);
    gradient -= information.lazyProduct(fromMinimum_);
    FullParameterVector change;
    if (part < kSmallPart)
      change = changeBySeries(information, gradient);
    else if (!changeBySolving(information, gradient, change))
      return;
    sum_.noalias() += change * change.transpose();
    ++count_;
  }
  int count() const { return count_; }
  FullParameterMatrix covariance() const { return sum_ * ((count_ - 1.0) / count_); }

 private:
  // (H - H_k)^-1 g = C (g + H_k C (g + H_k C (g + ..
  FullParameterVector changeBySeries(const FullParameterMatrix& information, const FullParameterVector& gradient) const {
    FullParameterVector change = covariance_.lazyProduct(gradient);
    for (int term = 0; term < kTerms; ++term) {
      const FullParameterVector next = gradient + information.lazyProduct(change);
      change = covariance_.lazyProduct(next);
    }
    return change;
  }
  bool changeBySolving(const FullParameterMatrix& information, const FullParameterVector& gradient,
                       FullParameterVector& change) const {
    const Eigen::LLT<FullParameterMatrix> rest(FullParameterMatrix::Identity() - root_.transpose() * information * root_);
    if (rest.info() != Eigen::Success || rest.matrixLLT().diagonal().minCoeff() < kLeastRest) return false;
    change = root_ * rest.solve(root_.transpose() * gradient);
    return true;
  }

  static constexpr double kSmallPart = 0.2;
  static constexpr int kTerms = 2;

  FullParameterMatrix covariance_, root_, sum_ = FullParameterMatrix::Zero();
  FullParameterVector fromMinimum_;  // of all, to the pose
  int count_ = 0;
};

Changes changesWithoutGroups(const LeastSquaresProblem& problem, const QueryPose& pose, const JackknifeGroups& groups,
                             const FullParameterMatrix& covariance, const ParameterVector& gradientOfAll) {
  FullParameterVector gradient = FullParameterVector::Zero();
  gradient.head(gradientOfAll.size()) = gradientOfAll;
  Changes changes(covariance, gradient);
  for (const NormalEquations& group : sumsOfGroups(problem, pose, groups)) changes.add(group, problem.estimated);
  return changes;
}

// In coordinates in which the covariance is the identity, the largest eigenvalue of the sum of G random matrices over N parameters exceeds
// 1 by chance, up to (1 + sqrt(N/G))^2.
double excessByChance(int groups, int parameters) {
  const double root = std::sqrt(static_cast<double>(parameters) / groups);
  return root * (2 + root);
}

// Puts as many of `count` groups together as leave `most`.
void divide(std::vector<int>& groups, int count, int most) {
  const int together = (count + most - 1) / most;
  for (int& group : groups) group /= together;
}

}  // namespace

JackknifeGroups jackknifeGroups(const CorrespondenceArrays& arrays, const QueryFeatures& features) {
  constexpr int kGroups = 64, kMostCameras = 1024;
  JackknifeGroups groups;
  groups.rays.reserve(arrays.rays().size());
  for (const correspondences::RayMatch& ray : arrays.rays()) groups.rays.push_back(ray.camera);
  divide(groups.rays, static_cast<int>(numberOf(groups.rays)), kMostCameras);
  groups.points = correspondences::allIndices(arrays.points().size());
  auto count = static_cast<int>(groups.points.size());
  if (features.areShared()) {
    std::vector<int> order(features.places().size(), -1);  // of the features of points
    count = 0;
    for (std::size_t i = 0; i < groups.points.size(); ++i) {
      int& place = order[static_cast<std::size_t>(features.ofPoint(i))];
      if (place < 0) place = count++;
      groups.points[i] = place;
    }
  }
  divide(groups.points, count, kGroups);
  return groups;
}

bool jackknifeCovariance(const LeastSquaresProblem& problem, const QueryPose& pose, const JackknifeGroups& groups,
                         const Derivatives& all, const std::optional<SharedInformation>& shared, ParameterMatrix& covariance) {
  if (!invertInformation(all.information, covariance)) return false;
  const int size = problem.estimated.parameters();
  const FullParameterMatrix independent = extendedByIdentity(covariance);
  const Changes changes = changesWithoutGroups(problem, pose, groups, independent, all.gradient);
  FullParameterMatrix jackknife = changes.covariance();
  if (shared) {
    jackknife.topLeftCorner(size, size) += covariance * shared->betweenGroups * covariance;
    covariance += ParameterMatrix(covariance * shared->all * covariance);
  }
  const Eigen::LLT<FullParameterMatrix> cholesky(extendedByIdentity(covariance));
  if (changes.count() >= 2 && cholesky.info() == Eigen::Success)
    covariance = enlarged(cholesky.matrixL(), jackknife, excessByChance(changes.count(), size)).topLeftCorner(size, size);
  return covariance.allFinite();
}

}  // namespace robust
}  // namespace hybridgv
