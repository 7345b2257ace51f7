#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "CheckArguments.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "correspondences/readCorrespondence.hpp"
#include "hybrid_pose/optimizeNonlinear.hpp"
#include "hybrid_pose/solveSample.hpp"
#include "hybridgv/detail/format.hpp"
#include "hybridgv/distortion.hpp"
#include "math/RandomStream.hpp"
#include "robust/SampleCheck.hpp"
#include "robust/Sampler.hpp"
#include "robust/kernels/Kernels.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

namespace {

using correspondences::CorrespondenceArrays;
using hybridgv::hybrid_pose::Sample;
using robust::Sampler;

void checkCount(const char* what, int available, int needed, const char* solver) {
  if (available < needed)
    throwInvalid("adapter", "has " + std::to_string(available) + " " + what + " correspondences, " + solver + " needs " +
                                std::to_string(needed));
}

void checkRange(const char* name, int index, int count) {
  if (index < 0 || index >= count)
    throwInvalid(name, "index " + std::to_string(index) + " is outside the " + std::to_string(count) + " correspondences");
}

void checkRanges(const char* name, const std::vector<int>& indices, int count) {
  for (const int index : indices) checkRange(name, index, count);
}

correspondences::Correspondences readAll(const hybridgv::hybrid_pose::HybridAdapterBase& adapter) {
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  if (counts.points > static_cast<std::size_t>(std::numeric_limits<int>::max()) - counts.rays)
    throwInvalid("adapter",
                 "flat indices count at most 2^31 - 1 correspondences, it has " + std::to_string(counts.rays + counts.points));
  return correspondences::readCorrespondences(adapter, correspondences::allIndices(counts.rays),
                                              correspondences::allIndices(counts.points));
}

template <class Match>
void undistortImagePoint(double distortion, Match& match) {
  const Eigen::Vector3d point = undistort(distortion, {match.u, match.v, 1});
  if (point[2] == 0)
    throwInvalid("distortion", "is " + detail::format(distortion) + ", with which the image point (" + detail::format(match.u) +
                                   ", " + detail::format(match.v) + ") has no viewing direction");
  match.u = point[0];
  match.v = point[1];
}

correspondences::Correspondences undistorted(correspondences::Correspondences correspondences, double distortion) {
  if (!std::isfinite(distortion)) throwInvalid("distortion", "must be finite, is " + detail::format(distortion));
  if (distortion == 0) return correspondences;
  for (correspondences::RigRay& ray : correspondences.rays) undistortImagePoint(distortion, ray.match);
  for (correspondences::PointMatch& match : correspondences.points) undistortImagePoint(distortion, match);
  return correspondences;
}

}  // namespace

struct HybridProblemCore::Data {
  Data(const hybridgv::hybrid_pose::HybridAdapterBase& adapter, Solver id, double reprojectionPx, double epipolarPx,
       std::optional<double> knownFocalLengthPx, double distortion)
      : problem(solvers::rowsOf(id)),
        correspondences(undistorted(readAll(adapter), distortion)),
        arrays(correspondences),
        maxReprojectionErrorPx(reprojectionPx),
        maxEpipolarErrorPx(epipolarPx),
        focalLength(checkedFocalLength(knownFocalLengthPx)) {
    arrays.fixUnknownFocalLengths(knownFocalLengthPx.value_or(0));
    checkPositive("maxReprojectionErrorPx", reprojectionPx);
    checkPositive("maxEpipolarErrorPx", epipolarPx);
    checkCount("2D-2D", count2d2d(), problem.rays(), problem.name());
    checkCount("2D-3D", count2d3d(), problem.points(), problem.name());
  }

  // 1, which no solver uses, where it is estimated.
  double checkedFocalLength(const std::optional<double>& known) const {
    const bool isEstimated = problem.begin()->intrinsics.focalLength;
    if (isEstimated && known)
      throwInvalid("knownFocalLengthPx",
                   std::string(problem.name()) + " estimates the focal length, is " + detail::format(*known));
    if (!isEstimated && !known) throwInvalid("knownFocalLengthPx", std::string(problem.name()) + " needs it");
    if (known) checkPositive("knownFocalLengthPx", *known);
    return known.value_or(1);
  }

  int count2d2d() const { return static_cast<int>(arrays.rays().size()); }
  int count2d3d() const { return static_cast<int>(arrays.points().size()); }
  int count() const { return count2d2d() + count2d3d(); }

  robust::PlainPose toPlain(const FocalPose& pose) const { return robust::toPlain(arrays.normalization().apply(pose)); }

  // Distances of correspondences to a pose, rays first.
  void computeDistances(const CorrespondenceArrays& of, const FocalPose& pose, std::vector<double>& result) const {
    const correspondences::RayArrays rays = of.rayArrays();
    const correspondences::PointArrays points = of.pointArrays();
    const robust::PlainPose plain = toPlain(pose);
    result.resize(rays.size + points.size + correspondences::kPadding);
    robust::kernels().squaredRayErrors(rays, plain, result.data());  // their padding is overwritten by the points
    robust::kernels().squaredPointErrors(points, plain, result.data() + rays.size);
    result.resize(rays.size + points.size);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double threshold = i < rays.size ? maxEpipolarErrorPx : maxReprojectionErrorPx;
      const double distance = std::sqrt(result[i] / (threshold * threshold));
      result[i] = distance < kMaxDistance ? distance : kMaxDistance;  // the comparison is false for NaN
    }
  }

  // The score and the inliers of a pose, with both thresholds multiplied by `factor`.
  robust::Score score(const CorrespondenceArrays& of, const FocalPose& pose, double factor) const {
    const correspondences::RayArrays rays = of.rayArrays();
    const correspondences::PointArrays points = of.pointArrays();
    const robust::PlainPose plain = toPlain(pose);
    const double maxRay = factor * maxEpipolarErrorPx, maxPoint = factor * maxReprojectionErrorPx;
    const robust::Score ofRays = robust::kernels().scoreRays(rays, plain, maxRay * maxRay, 0, rays.size);
    const robust::Score ofPoints = robust::kernels().scorePoints(points, plain, maxPoint * maxPoint, 0, points.size);
    return {ofRays.msac + ofPoints.msac, ofRays.inliers + ofPoints.inliers};
  }

  // Whether the list is 0, 1, .. : all correspondences in their order.
  bool isAll(const std::vector<int>& flat) const {
    if (flat.size() != static_cast<std::size_t>(count())) return false;
    for (std::size_t i = 0; i < flat.size(); ++i)
      if (flat[i] != static_cast<int>(i)) return false;
    return true;
  }

  // How the rays are drawn for the solver's faster way; the first row's.
  solvers::RayDraw fasterDraw() const { return problem.begin()->draw; }

  // What to draw: from any cameras where none has enough rays.
  robust::SampleSize sampleSize(const Sampler& sampler, bool raysFromOneCamera) const {
    const robust::SampleSize faster{problem.rays(), problem.points(), fasterDraw()};
    if (raysFromOneCamera && sampler.canDraw(faster)) return faster;
    return {problem.rays(), problem.points(), solvers::RayDraw::Uniform};
  }

  void checkPool(const char* name, const MultiIndices& indices) const {
    if (indices.size() != 2) throwInvalid(name, "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(indices.size()));
    checkRanges(name, indices[0], count2d2d());
    checkRanges(name, indices[1], count2d3d());
  }

  void checkSampleSize(std::size_t rays, std::size_t points) const {
    if (rays != static_cast<std::size_t>(problem.rays()) || points != static_cast<std::size_t>(problem.points()))
      throwInvalid("sample", std::string(problem.name()) + " needs " + std::to_string(problem.rays()) + " 2D-2D and " +
                                 std::to_string(problem.points()) + " 2D-3D correspondences, got " + std::to_string(rays) +
                                 " and " + std::to_string(points));
  }

  Sample read(const MultiIndices& sample) const {
    checkPool("sample", sample);
    checkSampleSize(sample[0].size(), sample[1].size());
    Sample result;
    for (std::size_t i = 0; i < sample[0].size(); ++i)
      result.rays[i] = correspondences.rays[static_cast<std::size_t>(sample[0][i])].match;
    for (std::size_t i = 0; i < sample[1].size(); ++i)
      result.points[i] = correspondences.points[static_cast<std::size_t>(sample[1][i])];
    return result;
  }

  Sample readFlat(const std::vector<int>& sample) const {
    checkRanges("sample", sample, count());
    const auto isRay = [this](int index) { return index < count2d2d(); };
    const auto rays = static_cast<std::size_t>(std::count_if(sample.begin(), sample.end(), isRay));
    checkSampleSize(rays, sample.size() - rays);
    Sample result;
    std::size_t ray = 0, point = 0;
    for (const int index : sample)
      if (isRay(index))
        result.rays[ray++] = correspondences.rays[static_cast<std::size_t>(index)].match;
      else
        result.points[point++] = correspondences.points[static_cast<std::size_t>(index - count2d2d())];
    return result;
  }

  bool isGood(const Sample& sample) const {
    return !robust::isDegenerate(sample.rays.data(), problem.rays(), sample.points.data(), problem.points());
  }

  const solvers::SolverRows problem;
  const correspondences::Correspondences correspondences;
  CorrespondenceArrays arrays;
  const double maxReprojectionErrorPx, maxEpipolarErrorPx;
  const double focalLength;  // for solvers that need it
};

// The sampler draws places in the list.
struct CorrespondencePool::Data {
  Data(const std::vector<int>& flat, const MultiIndices& lists, const CorrespondenceArrays& all, bool isAll)
      : indices(flat), sampler(makeSampler(flat, all)) {
    if (!isAll) part = all.subset(lists[0], lists[1]);
  }

  static Sampler makeSampler(const std::vector<int>& flat, const CorrespondenceArrays& all) {
    std::vector<int> cameras(flat.size()), rays, points;
    for (std::size_t place = 0; place < flat.size(); ++place) {
      const auto index = static_cast<std::size_t>(flat[place]);
      const bool isRay = index < all.rays().size();
      if (isRay) cameras[place] = all.rays()[index].camera;
      (isRay ? rays : points).push_back(static_cast<int>(place));
    }
    return {cameras, std::move(rays), std::move(points), false};
  }

  // What the pool is scored with.
  const CorrespondenceArrays& arrays(const CorrespondenceArrays& all) const { return part ? *part : all; }

  std::vector<int> indices;
  Sampler sampler;
  std::optional<CorrespondenceArrays> part;  // none: all correspondences in their order
};

CorrespondencePool::CorrespondencePool(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

const std::vector<int>& CorrespondencePool::indices() const { return data_->indices; }

HybridProblemCore::HybridProblemCore(const hybridgv::hybrid_pose::HybridAdapterBase& adapter, Solver solver,
                                     double maxReprojectionErrorPx, double maxEpipolarErrorPx,
                                     std::optional<double> knownFocalLengthPx, double distortion)
    : data_(std::make_shared<const Data>(adapter, solver, maxReprojectionErrorPx, maxEpipolarErrorPx, knownFocalLengthPx,
                                         distortion)) {}

std::array<int, 2> HybridProblemCore::size() const { return {data_->count2d2d(), data_->count2d3d()}; }
std::array<int, 2> HybridProblemCore::sampleSize() const { return {data_->problem.rays(), data_->problem.points()}; }

bool HybridProblemCore::drawsRaysFromOneCamera() const { return data_->fasterDraw() != solvers::RayDraw::Uniform; }

MultiIndices HybridProblemCore::split(const std::vector<int>& flat) const {
  checkRanges("indices", flat, data_->count());
  const int rays = data_->count2d2d();
  MultiIndices result(2);
  for (std::vector<int>& list : result) list.reserve(flat.size());
  for (int i : flat)
    if (i < rays)
      result[0].push_back(i);
    else
      result[1].push_back(i - rays);
  return result;
}

std::vector<int> HybridProblemCore::join(const MultiIndices& indices) const {
  data_->checkPool("indices", indices);
  std::vector<int> result;
  result.reserve(indices[0].size() + indices[1].size());
  result = indices[0];
  for (int i : indices[1]) result.push_back(i + data_->count2d2d());
  return result;
}

CorrespondencePool HybridProblemCore::makePool(const std::vector<int>& flat) const {
  return CorrespondencePool(
      std::make_shared<const CorrespondencePool::Data>(flat, split(flat), data_->arrays, data_->isAll(flat)));
}

void HybridProblemCore::drawSample(const CorrespondencePool& pool, bool raysFromOneCamera, const std::function<int()>& random,
                                   std::vector<int>& places) const {
  places.clear();
  const Sampler& sampler = pool.data_->sampler;
  const robust::SampleSize size = data_->sampleSize(sampler, raysFromOneCamera);
  if (!sampler.canDraw(size)) return;
  const auto high = static_cast<std::uint64_t>(random()), low = static_cast<std::uint64_t>(random());
  math::RandomStream stream(high << 31 | low, 0);
  const robust::DrawnSample sample = sampler.draw(size, 1, stream);
  places.insert(places.end(), sample.rays, sample.rays + size.rays);
  places.insert(places.end(), sample.points, sample.points + size.points);
}

bool HybridProblemCore::isSampleGood(const MultiIndices& sample) const { return data_->isGood(data_->read(sample)); }

bool HybridProblemCore::isFlatSampleGood(const std::vector<int>& sample) const { return data_->isGood(data_->readFlat(sample)); }

bool HybridProblemCore::computeModel(const MultiIndices& sample, const CorrespondencePool& pool, FocalPose& model) const {
  const Sample correspondences = data_->read(sample);
  if (!data_->isGood(correspondences)) return false;
  const solvers::MinimalSolver* const solver = data_->problem.forSample(correspondences.rays.data());
  if (!solver) return false;
  double best = -1;  // less than any score
  for (const FocalPose& solution : hybridgv::hybrid_pose::solve(*solver, correspondences, data_->focalLength)) {
    const double score = data_->score(pool.data_->arrays(data_->arrays), solution, 1).msac;
    if (!(score > best)) continue;
    best = score;
    model = solution;
  }
  return best >= 0;
}

void HybridProblemCore::distances(const FocalPose& model, const std::vector<int>& flat, std::vector<double>& result) const {
  if (data_->isAll(flat)) return data_->computeDistances(data_->arrays, model, result);
  const MultiIndices lists = split(flat);
  std::vector<double> raysFirst;
  data_->computeDistances(data_->arrays.subset(lists[0], lists[1]), model, raysFirst);
  std::size_t ray = 0, point = lists[0].size();
  result.resize(flat.size());
  for (std::size_t k = 0; k < flat.size(); ++k) result[k] = raysFirst[flat[k] < data_->count2d2d() ? ray++ : point++];
}

int HybridProblemCore::countWithin(const FocalPose& model, const CorrespondencePool& pool, double threshold) const {
  if (!(threshold >= 0)) throwInvalid("threshold", "must not be negative, is " + detail::format(threshold));
  return data_->score(pool.data_->arrays(data_->arrays), model, threshold).inliers;
}

FocalPose HybridProblemCore::optimize(const MultiIndices& inliers, const FocalPose& model) const {
  if (inliers.size() != 2) throwInvalid("inliers", "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(inliers.size()));
  checkMultiIndices("inliers", inliers, {static_cast<int>(inliers[0].size()), static_cast<int>(inliers[1].size())},
                    {data_->correspondences.rays.size(), data_->correspondences.points.size()});
  checkPose("model", model);
  return hybridgv::hybrid_pose::optimizeNonlinear(data_->correspondences.subset(inliers[0], inliers[1]), model,
                                                  data_->problem.begin()->intrinsics)
      .pose;
}

std::function<int()> randomSequence(std::uint64_t seed) {
  return [random = math::SplitMix64(seed)]() mutable { return static_cast<int>(random.next() >> 33); };
}

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv
