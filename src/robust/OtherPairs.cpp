#include "robust/OtherPairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "math/RandomStream.hpp"
#include "robust/NearestCandidates.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::CorrespondenceArrays;
using correspondences::padded;
using correspondences::PointMatch;
using correspondences::RayMatch;

// So many correspondences of a kind get random partners, at most so many partners each.
constexpr std::size_t kAskers = 256, kMostPartners = 64;
// With neighbours. Those of one object agree or disagree together, so that a share is only as exact as the number of askers; and the
// more correspondences there are, the smaller an excess over the share counts as no accident.
constexpr std::size_t kFewAskers = 32, kOfAll = 4;
constexpr std::uint64_t kPartnerStream = ~std::uint64_t{0} - 2;

std::size_t askersOfNeighbours(std::size_t all) { return std::min(all, std::clamp(all / kOfAll, kFewAskers, kAskers)); }

// Of the first matches, by group.
template <class Matches, class Group, class Position>
std::vector<Candidates> candidatesOf(const Matches& matches, Group group, Position position) {
  const std::size_t count = std::min(matches.size(), Candidates::kMost);
  const auto groupOf = [&](std::size_t j) { return static_cast<std::size_t>(group(matches[j])); };
  std::vector<std::size_t> sizes;
  for (std::size_t j = 0; j < count; ++j) {
    if (groupOf(j) >= sizes.size()) sizes.resize(groupOf(j) + 1, 0);
    ++sizes[groupOf(j)];
  }
  std::vector<Candidates> result(sizes.size());
  for (std::size_t of = 0; of < sizes.size(); ++of) result[of].reserve(sizes[of]);
  for (std::size_t j = 0; j < count; ++j) result[groupOf(j)].add(j, position(matches[j]));
  return result;
}

}  // namespace

OtherPairs::Partners OtherPairs::noPartners(std::size_t size, std::size_t rounds) {
  Partners partners;
  partners.size = size;
  partners.length = padded(size);
  partners.rounds = rounds;
  partners.u.assign(rounds * partners.length, std::numeric_limits<double>::quiet_NaN());
  partners.v = partners.u;
  return partners;
}

void OtherPairs::setPartner(std::size_t i, std::size_t round, double u, double v, Partners& partners) {
  partners.u[round * partners.length + i] = u;
  partners.v[round * partners.length + i] = v;
}

OtherPairs OtherPairs::random(const CorrespondenceArrays& arrays, const QueryFeatures& features, std::uint64_t seed,
                              std::size_t pairs, PartnersOf of) {
  OtherPairs result(arrays);
  const std::vector<ImagePoint> all = imagePoints(arrays);
  if (all.size() < 2) return result;
  math::RandomStream random(seed, kPartnerStream);
  // Because correspondences are in random order, the one that comes so many places after an asker is as good as any.
  const auto pairUp = [&](std::size_t first, std::size_t count) {
    const std::size_t askers = std::min(count, kAskers);
    const bool ofOwnKind = of == PartnersOf::OwnKind && count > 1;
    const std::size_t begin = ofOwnKind ? first : 0, size = ofOwnKind ? count : all.size();
    Partners partners = noPartners(askers, std::min(pairs / std::max<std::size_t>(askers, 1), kMostPartners));
    for (std::size_t round = 0; round < partners.rounds; ++round) {
      std::size_t other = begin + (first - begin + 1 + random.below(size - 1)) % size;
      for (std::size_t i = 0; i < askers; ++i, other = other + 1 < begin + size ? other + 1 : begin) {
        const bool isOwn = features.numbers()[other] == features.numbers()[first + i];
        if (isOwn) continue;
        setPartner(i, round, all[other].u, all[other].v, partners);
        ++partners.pairs;
      }
    }
    return partners;
  };
  result.rays_ = pairUp(0, arrays.rays().size());
  result.points_ = pairUp(arrays.rays().size(), arrays.points().size());
  return result;
}

template <class Matches, class Group, class Position, class IsSame>
OtherPairs::Partners OtherPairs::neighbours(const Matches& matches, Group group, Position position, IsSame isSame,
                                            WorkerPool* workers) {
  constexpr std::size_t kTogether = 64;  // fewer are not worth a second thread
  Partners partners = noPartners(askersOfNeighbours(matches.size()), Nearest::kMost);
  const std::vector<Candidates> candidates = candidatesOf(matches, group, position);
  std::vector<std::size_t> found(partners.size);
  const auto ask = [&](std::size_t i) {
    const Candidates& others = candidates[static_cast<std::size_t>(group(matches[i]))];
    const Nearest nearest(others, position(matches[i]), [&](std::size_t j) { return !isSame(i, j); });
    for (std::size_t k = 0; k < nearest.size(); ++k) setPartner(i, k, matches[nearest[k]].u, matches[nearest[k]].v, partners);
    found[i] = nearest.size();
  };
  forParts(workers, partners.size, kTogether, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ask(i);
  });
  partners.pairs = std::accumulate(found.begin(), found.end(), std::size_t{0});
  return partners;
}

OtherPairs OtherPairs::ofNeighbours(const CorrespondenceArrays& arrays, const Evidence& evidence, WorkerPool* workers,
                                    const Kinds& kinds) {
  OtherPairs result(arrays);
  if (kinds.rays)
    result.rays_ = neighbours(
        arrays.rays(), [](const RayMatch& ray) { return ray.camera; },
        [](const RayMatch& ray) -> const Eigen::Vector3d& { return ray.direction; },
        [&](std::size_t i, std::size_t j) { return evidence.isSameRay(i, j); }, workers);
  if (kinds.points)
    result.points_ = neighbours(
        arrays.points(), [](const PointMatch&) { return 0; },
        [](const PointMatch& match) -> const Eigen::Vector3d& { return match.point; },
        [&](std::size_t i, std::size_t j) { return evidence.isSamePoint(i, j); }, workers);
  return result;
}

// Four standard deviations, and what that lacks where few pairs agree.
Shares OtherPairs::mostOf(const Shares& shares) const {
  const auto most = [](const LevelShares& ofKind, std::size_t pairs) {
    LevelShares result = ofKind;
    const double count = static_cast<double>(std::max<std::size_t>(pairs, 1));
    for (double& share : result) share = std::min(share + 4 * std::sqrt(share * (1 - share) / count) + 8 / count, 1.);
    return result;
  };
  return {most(shares.rays, rays_.pairs), most(shares.points, points_.pairs)};
}

Shares OtherPairs::shares(const PlainPose& pose, double maxEpipolarError, double maxReprojectionError) const {
  std::vector<double> errors(padded(std::max(rays_.size, points_.size)));
  const auto count = [&](const Partners& partners, double threshold, auto setErrors) {
    LevelShares shares{};
    if (partners.pairs == 0) return shares;
    for (std::size_t round = 0; round < partners.rounds; ++round) {
      const std::size_t first = round * partners.length;
      setErrors(partners.u.data() + first, partners.v.data() + first);
      const LevelCounts counts = countLevels(errors.data(), partners.size, threshold * threshold);
      for (std::size_t level = 0; level < counts.size(); ++level) shares[level] += counts[level];
    }
    for (double& share : shares) share /= static_cast<double>(partners.pairs);
    return shares;
  };
  Shares result;
  result.rays = count(rays_, maxEpipolarError, [&](const double* u, const double* v) {
    correspondences::RayArrays rays = arrays_->rayArrays();
    rays.size = rays_.size;
    rays.u = u;
    rays.v = v;
    kernelsFor(pose).squaredRayErrors(rays, pose, errors.data());
  });
  result.points = count(points_, maxReprojectionError, [&](const double* u, const double* v) {
    correspondences::PointArrays points = arrays_->pointArrays();
    points.size = points_.size;
    points.u = u;
    points.v = v;
    kernelsFor(pose).squaredPointErrors(points, pose, errors.data());
  });
  return result;
}

}  // namespace robust
}  // namespace hybridgv
