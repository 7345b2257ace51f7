#include "robust/FeatureNoise.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "robust/ChosenArrays.hpp"
#include "robust/numberEqual.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Two vectors over the parameters: what two independent errors of variance 1 add to the gradient.
using TwoErrors = Eigen::Matrix<double, correspondences::kMostParameters, 2>;

// An inlier whose feature has other correspondences too.
struct Sharer {
  int feature, group, item;
  TwoErrors ofFeature, own;  // errors of the feature's image point, and those of this ray or point
};

int featureOf(const Sharer& s) { return s.feature; }
std::pair<int, int> groupOf(const Sharer& s) { return {s.feature, s.group}; }
std::tuple<int, int, int> itemOf(const Sharer& s) { return {s.feature, s.group, s.item}; }

// Which correspondences of a kind have a feature in common with others, with the numbers of their rays or points.
struct Sharing {
  Members members;
  std::vector<int> items;
};

std::vector<int> sizesOf(const QueryFeatures& features) {
  std::vector<int> sizes(features.places().size(), 0);
  for (const int feature : features.numbers()) ++sizes[static_cast<std::size_t>(feature)];
  return sizes;
}

template <class Feature, class Item>
Sharing sharingOf(std::size_t count, const std::vector<int>& sizes, Feature featureOf, Item itemOf) {
  Sharing result;
  std::vector<Key> keys;
  for (std::size_t i = 0; i < count; ++i) {
    if (sizes[static_cast<std::size_t>(featureOf(i))] < 2) continue;
    result.members.push_back(i);
    keys.push_back(itemOf(i));
  }
  result.items = numberEqual(keys).numbers;
  return result;
}

// The rows of the kernels, of which each column has the padded size.
class Rows {
 public:
  Rows(std::size_t size, std::size_t columns) : length_(correspondences::padded(size)), values_(columns * length_) {}
  double* data() { return values_.data(); }
  double operator()(std::size_t row, std::size_t column) const { return values_[column * length_ + row]; }
  double weight(std::size_t row) const { return (*this)(row, 0); }
  // By the parameters.
  FullParameterVector derivatives(std::size_t row, std::size_t firstColumn) const {
    FullParameterVector result;
    for (Eigen::Index k = 0; k < result.size(); ++k) result[k] = (*this)(row, firstColumn + static_cast<std::size_t>(k));
    return result;
  }

 private:
  std::size_t length_;
  std::vector<double> values_;
};

constexpr std::size_t kFirstDerivative = 1, kSecondDerivative = 1 + correspondences::kMostParameters;

class Sharers {
 public:
  Sharers(const LeastSquaresProblem& problem, const QueryPose& pose, const QueryFeatures& features, const JackknifeGroups& groups)
      : problem_(problem), features_(features), groups_(groups), pose_(toPlain(pose)), sizes_(sizesOf(features)) {
    if (!problem.estimated.radial) pose_.distortion = 0;
    double largest = 0;
    if (problem.kinds.rays) largest = std::max(largest, problem.rayLoss.precision);
    if (problem.kinds.points) largest = std::max(largest, problem.pointLoss.precision);
    variance_ = 1 / largest;
    if (problem.kinds.rays) addRays();
    if (problem.kinds.points) addPoints();
  }

  // Sorted, so that those of a feature follow each other, of these those of a group, and of these those with the same item.
  std::vector<const Sharer*> sorted() const {
    std::vector<const Sharer*> result;
    result.reserve(list_.size());
    for (const Sharer& sharer : list_) result.push_back(&sharer);
    std::stable_sort(result.begin(), result.end(), [](const Sharer* a, const Sharer* b) { return itemOf(*a) < itemOf(*b); });
    return result;
  }

 private:
  void addRays() {
    const RayArrays& rays = problem_.rays;
    const auto featureOf = [&](std::size_t i) { return features_.ofRay(i); };
    const Sharing sharing = sharingOf(rays.size, sizes_, featureOf, [&](std::size_t i) {
      return keyOf(std::array<double, 6>{rays.cx[i], rays.cy[i], rays.cz[i], rays.dx[i], rays.dy[i], rays.dz[i]});
    });
    ChosenArrays chosen;
    Rows rows(sharing.members.size(), kRayRow);
    problem_.kernels->rayRows(chosen.rays(rays, sharing.members), pose_, problem_.rayLoss, rows.data());
    for (std::size_t k = 0; k < sharing.members.size(); ++k) {
      const double weight = rows.weight(k);
      if (!(weight > 0)) continue;
      const std::size_t i = sharing.members[k];
      const Eigen::Vector2d byImagePoint(rows(k, kRayRow - 2), rows(k, kRayRow - 1));
      const FullParameterVector gradient = weight * rows.derivatives(k, kFirstDerivative);
      Sharer sharer{features_.ofRay(i), groups_.rays[i], sharing.items[k], gradient * byImagePoint.transpose(), {}};
      sharer.ofFeature *= std::sqrt(variance_);
      sharer.own.setZero();
      sharer.own.col(0) = std::sqrt(std::max(1 / weight - variance_ * byImagePoint.squaredNorm(), 0.)) * gradient;
      list_.push_back(sharer);
    }
  }

  void addPoints() {
    const PointArrays& points = problem_.points;
    const auto featureOf = [&](std::size_t i) { return features_.ofPoint(i); };
    const Sharing sharing = sharingOf(points.size, sizes_, featureOf, [&](std::size_t i) {
      return keyOf(std::array<double, 3>{points.x[i], points.y[i], points.z[i]});
    });
    ChosenArrays chosen;
    Rows rows(sharing.members.size(), kPointRow);
    problem_.kernels->pointRows(chosen.points(points, sharing.members), pose_, problem_.pointLoss, rows.data());
    for (std::size_t k = 0; k < sharing.members.size(); ++k) {
      const double weight = rows.weight(k);
      if (!(weight > 0)) continue;
      const std::size_t i = sharing.members[k];
      TwoErrors gradient;
      gradient << weight * rows.derivatives(k, kFirstDerivative), weight * rows.derivatives(k, kSecondDerivative);
      // The error is the projection less the image point. Points are in groups of their own.
      list_.push_back({features_.ofPoint(i), ~groups_.points[i], sharing.items[k], -std::sqrt(variance_) * gradient,
                       std::sqrt(std::max(1 / weight - variance_, 0.)) * gradient});
    }
  }

  const LeastSquaresProblem& problem_;
  const QueryFeatures& features_;
  const JackknifeGroups& groups_;
  PlainPose pose_;
  std::vector<int> sizes_;
  double variance_;  // of the coordinates of a feature's image point
  std::vector<Sharer> list_;
};

// Sharers with the same key, which follow each other, have errors in common. These add up before they are squared: the difference that
// this makes.
template <class KeyOf>
FullParameterMatrix sharedSquares(const std::vector<const Sharer*>& sharers, TwoErrors Sharer::*errors, KeyOf keyOf) {
  FullParameterMatrix result = FullParameterMatrix::Zero();
  for (auto first = sharers.begin(); first != sharers.end();) {
    const auto end = std::find_if(first, sharers.end(), [&](const Sharer* s) { return keyOf(*s) != keyOf(**first); });
    if (end - first > 1) {
      TwoErrors sum = TwoErrors::Zero();
      for (auto it = first; it != end; ++it) {
        const TwoErrors& own = (**it).*errors;
        sum += own;
        result.noalias() -= own * own.transpose();
      }
      result.noalias() += sum * sum.transpose();
    }
    first = end;
  }
  return result;
}

ParameterMatrix estimated(const FullParameterMatrix& matrix, Intrinsics intrinsics) {
  NormalEquations sums;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = row; column < matrix.cols(); ++column) sums.hessian[row][column] = matrix(row, column);
  return estimatedPart(sums, intrinsics);
}

}  // namespace

std::optional<SharedInformation> sharedInformation(const LeastSquaresProblem& problem, const QueryPose& pose,
                                                   const QueryFeatures& features, const JackknifeGroups& groups) {
  if (!features.areShared()) return std::nullopt;
  const Sharers list(problem, pose, features, groups);
  const std::vector<const Sharer*> sharers = list.sorted();
  const FullParameterMatrix ofFeatures = sharedSquares(sharers, &Sharer::ofFeature, featureOf);
  const FullParameterMatrix ofGroups = sharedSquares(sharers, &Sharer::ofFeature, groupOf);
  const FullParameterMatrix ofItems = sharedSquares(sharers, &Sharer::own, itemOf);
  return SharedInformation{estimated(ofFeatures + ofItems, problem.estimated),
                           estimated(ofFeatures - ofGroups, problem.estimated)};
}

}  // namespace robust
}  // namespace hybridgv
