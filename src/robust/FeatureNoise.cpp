#include "robust/FeatureNoise.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "robust/ChosenArrays.hpp"
#include "robust/KernelRows.hpp"
#include "robust/numberEqual.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Derivatives by the parameters of two errors: of a point, along u and v; of a ray, which has one, with a second that is always 0.
using TwoErrors = Eigen::Matrix<double, correspondences::kMostParameters, 2>;

// A correspondence whose feature has others too. Equal items are the same ray, or the same point.
struct Place {
  int feature, group, item;
  std::size_t index;
};

// What an inlier among them adds.
struct Sharer {
  int feature = 0, group = 0, item = 0;
  double weight = 0;
  TwoErrors gradient = TwoErrors::Zero();                  // the derivatives times the weight
  Eigen::Matrix2d byImagePoint = Eigen::Matrix2d::Zero();  // derivatives of the errors, one in a row
  Eigen::Vector2d errors = Eigen::Vector2d::Zero();

  // What unit errors of the feature's image point add to the gradient.
  TwoErrors ofFeature() const { return gradient * byImagePoint; }
  // What errors of the ray or point itself add, where the coordinates of the feature's image point have this variance.
  TwoErrors own(double variance) const {
    const double rest = 1 / weight - variance * byImagePoint.row(0).squaredNorm();
    return std::sqrt(std::max(rest, 0.)) * gradient;
  }
};

template <class Thing>
int featureOf(const Thing& t) {
  return t.feature;
}
template <class Thing>
std::pair<int, int> groupOf(const Thing& t) {
  return {t.feature, t.group};
}
template <class Thing>
std::tuple<int, int, int> itemOf(const Thing& t) {
  return {t.feature, t.group, t.item};
}

std::vector<int> sizesOf(const QueryFeatures& features) {
  std::vector<int> sizes(features.places().size(), 0);
  for (const int feature : features.numbers()) ++sizes[static_cast<std::size_t>(feature)];
  return sizes;
}

// Of one kind, in order: those of a feature follow each other, of these those of a group, and of these those with the same item.
template <class Feature, class Group, class Item>
std::vector<Place> placesOf(std::size_t count, const std::vector<int>& sizes, Feature feature, Group group, Item item) {
  std::vector<Place> places;
  std::vector<Key> keys;
  for (std::size_t i = 0; i < count; ++i) {
    if (sizes[static_cast<std::size_t>(feature(i))] < 2) continue;
    places.push_back({feature(i), group(i), 0, i});
    keys.push_back(item(i));
  }
  const Numbering items = numberEqual(keys);
  for (std::size_t k = 0; k < places.size(); ++k) places[k].item = items.numbers[k];
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.feature, a.group, a.item, a.index) < std::tie(b.feature, b.group, b.item, b.index);
  });
  return places;
}

Members indicesOf(const std::vector<Place>& places) {
  Members indices;
  indices.reserve(places.size());
  for (const Place& place : places) indices.push_back(place.index);
  return indices;
}

class Sharers {
 public:
  Sharers(const LeastSquaresProblem& problem, const QueryPose& pose, const QueryFeatures& features, const JackknifeGroups& groups)
      : problem_(problem), features_(features), groups_(groups), pose_(toPlain(pose)), sizes_(sizesOf(features)) {
    if (!problem.estimated.radial) pose_.distortion = 0;
    if (problem.kinds.rays) addRays();
    if (problem.kinds.points) addPoints();
  }

  // Of both kinds, ordered as their places.
  std::vector<const Sharer*> sorted() const {
    std::vector<const Sharer*> result;
    result.reserve(rays_.size() + points_.size());
    auto point = points_.begin();
    for (const Sharer& ray : rays_) {
      for (; point != points_.end() && itemOf(*point) < itemOf(ray); ++point) result.push_back(&*point);
      result.push_back(&ray);
    }
    for (; point != points_.end(); ++point) result.push_back(&*point);
    return result;
  }

 private:
  void addRays() {
    const RayArrays& rays = problem_.rays;
    const std::vector<Place> places = placesOf(
        rays.size, sizes_, [&](std::size_t i) { return features_.ofRay(i); }, [&](std::size_t i) { return groups_.rays[i]; },
        [&](std::size_t i) {
          return keyOf(std::array<double, 6>{rays.cx[i], rays.cy[i], rays.cz[i], rays.dx[i], rays.dy[i], rays.dz[i]});
        });
    ChosenArrays chosen;
    KernelRows rows(places.size(), kRayRow);
    problem_.kernels->rayRows(chosen.rays(rays, indicesOf(places)), pose_, problem_.rayLoss, rows.data());
    addInliers(places, rows, rays_, [&](std::size_t row, Sharer& sharer) {
      sharer.gradient.col(0) = sharer.weight * rows.derivatives(row, kFirstDerivative);
      sharer.byImagePoint << rows(row, kRayRow - 3), rows(row, kRayRow - 2), 0, 0;
      sharer.errors << rows(row, kRayRow - 1), 0;
    });
  }

  void addPoints() {
    const PointArrays& points = problem_.points;
    const std::vector<Place> places = placesOf(
        points.size, sizes_, [&](std::size_t i) { return features_.ofPoint(i); },
        [&](std::size_t i) { return ~groups_.points[i]; },  // other groups than those of rays
        [&](std::size_t i) {
          return keyOf(std::array<double, 3>{points.x[i], points.y[i], points.z[i]});
        });
    ChosenArrays chosen;
    KernelRows rows(places.size(), kPointRow);
    problem_.kernels->pointRows(chosen.points(points, indicesOf(places)), pose_, problem_.pointLoss, rows.data());
    addInliers(places, rows, points_, [&](std::size_t row, Sharer& sharer) {
      sharer.gradient.col(0) = sharer.weight * rows.derivatives(row, kFirstDerivative);
      sharer.gradient.col(1) = sharer.weight * rows.derivatives(row, kSecondDerivative);
      sharer.byImagePoint = -Eigen::Matrix2d::Identity();  // the error is the projection less the image point
      sharer.errors << rows(row, kPointRow - 2), rows(row, kPointRow - 1);
    });
  }

  // `fill` is called with the row of each.
  template <class Fill>
  static void addInliers(const std::vector<Place>& places, const KernelRows& rows, std::vector<Sharer>& list, Fill fill) {
    list.reserve(places.size());
    for (std::size_t row = 0; row < places.size(); ++row) {
      if (!(rows.weight(row) > 0)) continue;
      list.emplace_back();
      std::tie(list.back().feature, list.back().group, list.back().item) = itemOf(places[row]);
      list.back().weight = rows.weight(row);
      fill(row, list.back());
    }
  }

  const LeastSquaresProblem& problem_;
  const QueryFeatures& features_;
  const JackknifeGroups& groups_;
  PlainPose pose_;
  std::vector<int> sizes_;
  std::vector<Sharer> rays_, points_;
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
void forEqual(const std::vector<const Sharer*>& sharers, KeyOf keyOf, Body body) {
  for (auto first = sharers.begin(); first != sharers.end();) {
    const auto end = std::find_if(first, sharers.end(), [&](const Sharer* s) { return keyOf(*s) != keyOf(**first); });
    body(first, end);
    first = end;
  }
}

// Least squares over the pairs of errors of one feature, each divided by its deviation. A few pairs, which would not tell much, are added
// for the variance of the kind that has the smaller one.
double varianceOfFeatures(const LeastSquaresProblem& problem, const std::vector<const Sharer*>& sharers) {
  constexpr double kEnough = 10, kMost = 4;
  double precision = 0;
  if (problem.kinds.rays) precision = std::max(precision, problem.rayLoss.precision);
  if (problem.kinds.points) precision = std::max(precision, problem.pointLoss.precision);
  PairSums pairs;
  forEqual(sharers, featureOf<Sharer>, [&](auto first, auto end) { addPairs(first, end, pairs); });
  const double ratio = (kEnough + pairs.products / precision) / (kEnough + pairs.coefficients / precision / precision);
  return std::clamp(ratio, 0., kMost) / precision;
}

// Sharers with equal keys have errors in common. These add up before they are squared: the difference that this makes.
template <class KeyOf, class Errors>
FullParameterMatrix sharedSquares(const std::vector<const Sharer*>& sharers, KeyOf keyOf, Errors errorsOf) {
  FullParameterMatrix result = FullParameterMatrix::Zero();
  forEqual(sharers, keyOf, [&](auto first, auto end) {
    if (end - first < 2) return;
    TwoErrors sum = TwoErrors::Zero();
    for (auto it = first; it != end; ++it) {
      const TwoErrors errors = errorsOf(**it);
      sum += errors;
      result.noalias() -= errors * errors.transpose();
    }
    result.noalias() += sum * sum.transpose();
  });
  return result;
}

}  // namespace

std::optional<SharedInformation> sharedInformation(const LeastSquaresProblem& problem, const QueryPose& pose,
                                                   const QueryFeatures& features, const JackknifeGroups& groups) {
  if (!features.areShared()) return std::nullopt;
  const Sharers list(problem, pose, features, groups);
  const std::vector<const Sharer*> sharers = list.sorted();
  const double variance = varianceOfFeatures(problem, sharers);
  const auto ofFeature = [](const Sharer& sharer) { return sharer.ofFeature(); };
  const auto own = [&](const Sharer& sharer) { return sharer.own(variance); };
  const FullParameterMatrix ofFeatures = variance * sharedSquares(sharers, featureOf<Sharer>, ofFeature);
  const FullParameterMatrix ofGroups = variance * sharedSquares(sharers, groupOf<Sharer>, ofFeature);
  const FullParameterMatrix ofItems = sharedSquares(sharers, itemOf<Sharer>, own);
  SharedInformation result{estimatedPart(ofFeatures + ofItems, problem.estimated),
                           estimatedPart(ofFeatures - ofGroups, problem.estimated)};
  // Where squares of derivatives are beyond the doubles, nothing can be said.
  if (!result.all.allFinite() || !result.betweenGroups.allFinite()) return std::nullopt;
  return result;
}

}  // namespace robust
}  // namespace hybridgv
