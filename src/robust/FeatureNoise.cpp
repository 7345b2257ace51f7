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

// Derivatives by the parameters of two errors: of a point, along u and v; of a ray, which has one, with a second that is always 0.
using TwoErrors = Eigen::Matrix<double, correspondences::kMostParameters, 2>;

// An inlier whose feature has other correspondences too.
struct Sharer {
  int feature = 0, group = 0, item = 0;
  double weight = 0;
  TwoErrors gradient = TwoErrors::Zero();                  // the derivatives times the weight
  Eigen::Matrix2d byImagePoint = Eigen::Matrix2d::Zero();  // derivatives of the errors, one in a row
  Eigen::Vector2d errors = Eigen::Vector2d::Zero();
  // What errors of the feature's image point, and those of the ray or point itself, add to the gradient.
  TwoErrors ofFeature = TwoErrors::Zero(), own = TwoErrors::Zero();

  // With this variance of the coordinates of the feature's image point.
  void split(double variance) {
    ofFeature = std::sqrt(variance) * gradient * byImagePoint;
    const double rest = 1 / weight - variance * byImagePoint.row(0).squaredNorm();
    own = std::sqrt(std::max(rest, 0.)) * gradient;
  }
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
    if (problem.kinds.rays) addRays();
    if (problem.kinds.points) addPoints();
  }

  // Those of a feature follow each other, of these those of a group, and of these those with the same item.
  std::vector<Sharer*> sorted() {
    std::vector<Sharer*> result;
    result.reserve(list_.size());
    for (Sharer& sharer : list_) result.push_back(&sharer);
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
    addInliers(sharing, rows, [&](std::size_t row, std::size_t i, Sharer& sharer) {
      sharer.feature = features_.ofRay(i);
      sharer.group = groups_.rays[i];
      sharer.gradient.col(0) = sharer.weight * rows.derivatives(row, kFirstDerivative);
      sharer.byImagePoint << rows(row, kRayRow - 3), rows(row, kRayRow - 2), 0, 0;
      sharer.errors << rows(row, kRayRow - 1), 0;
    });
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
    addInliers(sharing, rows, [&](std::size_t row, std::size_t i, Sharer& sharer) {
      sharer.feature = features_.ofPoint(i);
      sharer.group = ~groups_.points[i];  // other groups than those of rays
      sharer.gradient.col(0) = sharer.weight * rows.derivatives(row, kFirstDerivative);
      sharer.gradient.col(1) = sharer.weight * rows.derivatives(row, kSecondDerivative);
      sharer.byImagePoint = -Eigen::Matrix2d::Identity();  // the error is the projection less the image point
      sharer.errors << rows(row, kPointRow - 2), rows(row, kPointRow - 1);
    });
  }

  // Calls fill(row, index of the correspondence, sharer) for each.
  template <class Fill>
  void addInliers(const Sharing& sharing, const Rows& rows, Fill fill) {
    for (std::size_t row = 0; row < sharing.members.size(); ++row) {
      if (!(rows.weight(row) > 0)) continue;
      Sharer sharer;
      sharer.item = sharing.items[row];
      sharer.weight = rows.weight(row);
      fill(row, sharing.members[row], sharer);
      list_.push_back(sharer);
    }
  }

  const LeastSquaresProblem& problem_;
  const QueryFeatures& features_;
  const JackknifeGroups& groups_;
  PlainPose pose_;
  std::vector<int> sizes_;
  std::vector<Sharer> list_;
};

// Sums over the pairs of different rays or points of one feature.
struct PairSums {
  double products = 0;      // of w_i w_j (a_i . a_j) e_i e_j
  double coefficients = 0;  // of w_i w_j (a_i . a_j)^2
};

// Of the sharers of one feature. Copies count once.
template <class Iterator>
void addPairs(Iterator first, Iterator end, PairSums& sums) {
  Eigen::Vector2d errors = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (auto it = first; it != end; ++it) {
    const Sharer& sharer = **it;
    if (it != first && itemOf(sharer) == itemOf(**(it - 1))) continue;
    const Eigen::Matrix2d weighted = sharer.weight * sharer.byImagePoint.transpose();
    const Eigen::Vector2d own = weighted * sharer.errors;
    const Eigen::Matrix2d ownInformation = weighted * sharer.byImagePoint;
    sums.products += errors.dot(own);
    sums.coefficients += information.cwiseProduct(ownInformation).sum();
    errors += own;
    information += ownInformation;
  }
}

// Calls body(first, end) for those with equal keys, which follow each other.
template <class KeyOf, class Body>
void forEqual(const std::vector<Sharer*>& sharers, KeyOf keyOf, Body body) {
  for (auto first = sharers.begin(); first != sharers.end();) {
    const auto end = std::find_if(first, sharers.end(), [&](const Sharer* s) { return keyOf(*s) != keyOf(**first); });
    body(first, end);
    first = end;
  }
}

// Least squares over the pairs of errors of one feature, each divided by its deviation. A few pairs, which would not tell much, are added
// for the variance of the kind that has the smaller one.
double varianceOfFeatures(const LeastSquaresProblem& problem, const std::vector<Sharer*>& sharers) {
  constexpr double kEnough = 10, kMost = 4;
  double precision = 0;
  if (problem.kinds.rays) precision = std::max(precision, problem.rayLoss.precision);
  if (problem.kinds.points) precision = std::max(precision, problem.pointLoss.precision);
  PairSums pairs;
  forEqual(sharers, featureOf, [&](auto first, auto end) { addPairs(first, end, pairs); });
  const double ratio = (kEnough + pairs.products / precision) / (kEnough + pairs.coefficients / (precision * precision));
  return std::clamp(ratio, 0., kMost) / precision;
}

// Sharers with equal keys have errors in common. These add up before they are squared: the difference that this makes.
template <class KeyOf>
FullParameterMatrix sharedSquares(const std::vector<Sharer*>& sharers, TwoErrors Sharer::*errors, KeyOf keyOf) {
  FullParameterMatrix result = FullParameterMatrix::Zero();
  forEqual(sharers, keyOf, [&](auto first, auto end) {
    if (end - first < 2) return;
    TwoErrors sum = TwoErrors::Zero();
    for (auto it = first; it != end; ++it) {
      const TwoErrors& own = (**it).*errors;
      sum += own;
      result.noalias() -= own * own.transpose();
    }
    result.noalias() += sum * sum.transpose();
  });
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
  Sharers list(problem, pose, features, groups);
  const std::vector<Sharer*> sharers = list.sorted();
  const double variance = varianceOfFeatures(problem, sharers);
  for (Sharer* sharer : sharers) sharer->split(variance);
  const FullParameterMatrix ofFeatures = sharedSquares(sharers, &Sharer::ofFeature, featureOf);
  const FullParameterMatrix ofGroups = sharedSquares(sharers, &Sharer::ofFeature, groupOf);
  const FullParameterMatrix ofItems = sharedSquares(sharers, &Sharer::own, itemOf);
  return SharedInformation{estimated(ofFeatures + ofItems, problem.estimated),
                           estimated(ofFeatures - ofGroups, problem.estimated)};
}

}  // namespace robust
}  // namespace hybridgv
