#include "robust/Jackknife.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "robust/ChosenArrays.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Without a group that has nearly all the information in some direction, one step says nothing. (Of the square root of what is left.)
constexpr double kLeastRest = 1e-3;

using Members = std::vector<std::size_t>;

std::vector<Members> membersOf(const std::vector<int>& groups) {
  std::vector<Members> result;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto group = static_cast<std::size_t>(groups[i]);
    if (result.size() <= group) result.resize(group + 1);
    result[group].push_back(i);
  }
  return result;
}

// The sums of one group after the other.
class GroupSums {
 public:
  GroupSums(const LeastSquaresProblem& problem, const QueryPose& pose) : problem_(problem), pose_(toPlain(pose)) {}

  NormalEquations ofPoints(const Members& members) {
    NormalEquations sums;
    problem_.kernels->addPoints(chosen_.points(problem_.points, members), pose_, problem_.pointLoss, sums);
    return sums;
  }

  NormalEquations ofRays(const Members& members) {
    NormalEquations sums;
    problem_.kernels->addRays(chosen_.rays(problem_.rays, members), pose_, problem_.rayLoss, sums);
    return sums;
  }

 private:
  const LeastSquaresProblem& problem_;
  PlainPose pose_;
  ChosenArrays chosen_;
};

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
    gradient -= information * fromMinimum_;
    FullParameterVector change;
    if (part < kSmallPart)
      change = changeBySeries(information, gradient);
    else if (!changeBySolving(information, gradient, change))
      return;
    sum_ += change * change.transpose();
    ++count_;
  }
  int count() const { return count_; }
  FullParameterMatrix covariance() const { return sum_ * ((count_ - 1.0) / count_); }

 private:
  // (H - H_k)^-1 g = C (g + H_k C (g + H_k C (g + ..
  FullParameterVector changeBySeries(const FullParameterMatrix& information, const FullParameterVector& gradient) const {
    FullParameterVector change = covariance_ * gradient;
    for (int term = 0; term < kTerms; ++term) change = covariance_ * (gradient + information * change);
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
  static constexpr int kTerms = 3;

  FullParameterMatrix covariance_, root_, sum_ = FullParameterMatrix::Zero();
  FullParameterVector fromMinimum_;  // of all, to the pose
  int count_ = 0;
};

Changes changesWithoutGroups(const LeastSquaresProblem& problem, const QueryPose& pose, const JackknifeGroups& groups,
                             const FullParameterMatrix& covariance, const ParameterVector& gradientOfAll) {
  FullParameterVector gradient = FullParameterVector::Zero();
  gradient.head(gradientOfAll.size()) = gradientOfAll;
  Changes changes(covariance, gradient);
  GroupSums sums(problem, pose);
  if (problem.kinds.rays)
    for (const Members& members : membersOf(groups.rays)) changes.add(sums.ofRays(members), problem.estimated);
  if (problem.kinds.points)
    for (const Members& members : membersOf(groups.points)) changes.add(sums.ofPoints(members), problem.estimated);
  return changes;
}

// In coordinates in which the covariance is the identity, the largest eigenvalue of the sum of G random matrices over N parameters exceeds
// 1 by chance, up to (1 + sqrt(N/G))^2.
double excessByChance(int groups, int parameters) {
  const double root = std::sqrt(static_cast<double>(parameters) / groups);
  return root * (2 + root);
}

}  // namespace

JackknifeGroups jackknifeGroups(const CorrespondenceArrays& arrays, const QueryFeatures& features) {
  constexpr std::size_t kGroups = 64;
  JackknifeGroups groups;
  for (const correspondences::RayMatch& ray : arrays.rays()) groups.rays.push_back(ray.camera);
  std::vector<int> order(features.places().size(), -1);  // of the features of points
  int count = 0;
  for (std::size_t i = 0; i < arrays.points().size(); ++i) {
    int& place = order[static_cast<std::size_t>(features.ofPoint(i))];
    if (place < 0) place = count++;
    groups.points.push_back(place);
  }
  const int together = (count + static_cast<int>(kGroups) - 1) / static_cast<int>(kGroups);
  for (int& group : groups.points) group /= together;
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
