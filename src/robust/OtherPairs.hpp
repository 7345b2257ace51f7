// How many image points of other correspondences a pose would take for a correspondence's own.
#pragma once

#include <cstdint>
#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/Evidence.hpp"
#include "robust/Levels.hpp"
#include "robust/PerKind.hpp"
#include "robust/WorkerPool.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

// A wrong pose's inliers are accidents. How frequent such accidents are depends on the data: image points that crowd in a few places,
// or points of the rig that look like one from afar, agree with a wrong pose far more often than evenly spread ones. So it is
// measured: rays and points are paired with image points of *other* correspondences, which are wrong for them, and the share of these
// pairs that have an error below a threshold is counted.
class OtherPairs {
 public:
  // So many of each kind: a share of one in a thousand is still seen.
  static constexpr std::size_t kPairs = 2048;
  // Of which kind a correspondence's partners are. The own one tells where only that kind crowds, and less where it has but a few.
  enum class PartnersOf { EitherKind, OwnKind };
  // Random partners. The own feature's image point may be drawn, but is no partner. `pairs` of each kind, or nearly.
  static OtherPairs random(const correspondences::CorrespondenceArrays& arrays, const QueryFeatures& features, std::uint64_t seed,
                           std::size_t pairs = kPairs, PartnersOf of = PartnersOf::EitherKind);
  // Partners are the image points of neighbours: of the nearest points in space, of the nearest rays of the same rig camera. Where
  // wrong matches connect one object with the image of another, a pose that takes one for the other has more inliers than random
  // pairs have, but nothing agrees inside an object.
  static OtherPairs ofNeighbours(const correspondences::CorrespondenceArrays& arrays, const Evidence& evidence,
                                 WorkerPool* workers = nullptr, const Kinds& kinds = kBothKinds);

  // What the shares of many more such pairs would hardly exceed, by those of these.
  Shares mostOf(const Shares& shares) const;
  // The shares at a pose in the arrays' frame. The arrays, which are in random order, must still exist.
  Shares shares(const PlainPose& pose, double maxEpipolarError, double maxReprojectionError) const;

 private:
  // The first `size` correspondences of a kind get another image point in each round, one `length` after the other; NaN is none.
  struct Partners {
    std::size_t size = 0, length = 0, rounds = 0, pairs = 0;
    std::vector<double> u, v;
  };
  explicit OtherPairs(const correspondences::CorrespondenceArrays& arrays) : arrays_(&arrays) {}
  static Partners noPartners(std::size_t size, std::size_t rounds);
  static void setPartner(std::size_t i, std::size_t round, double u, double v, Partners& partners);
  template <class Matches, class Group, class Position, class IsSame>
  static Partners neighbours(const Matches& matches, Group group, Position position, IsSame isSame, WorkerPool* workers);

  const correspondences::CorrespondenceArrays* arrays_;
  Partners rays_, points_;
};

}  // namespace robust
}  // namespace hybridgv
