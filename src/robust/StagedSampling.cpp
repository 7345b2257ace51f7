#include "robust/StagedSampling.hpp"

#include <algorithm>

#include "robust/toPlain.hpp"
#include "solvers/one_centre/SeventhRay.hpp"

namespace hybridgv {
namespace robust {
namespace {

using namespace solvers::one_centre;

// A motion with less than this share of the best score so far is not worth a seventh ray.
constexpr double kWorthASeventh = 0.5;
// So many rays of a camera, in random order, tell what all of them would.
constexpr std::size_t kEnoughRays = 128;

static_assert(StagedSampling::kMaxPoses == kMaxOneFocalMotions * StagedSampling::kSeventhRays, "");
static_assert(StagedSampling::kMaxPoses <= solvers::kMaxSolutions, "");

// At distance 1 from the camera.
QueryPose poseOf(const OneFocalMotion& motion, const Eigen::Vector3d& centre, double imageScale, double distortion) {
  QueryPose pose;
  pose.rotation = motion.rotation.transpose();
  pose.position = centre - motion.baseline;
  pose.focalLength = motion.focalLength * imageScale;
  pose.distortion = distortion;
  return pose;
}

}  // namespace

StagedSampling::StagedSampling(const SearchData& data) : sampler_(data.sampler) {
  for (int camera = 0; camera < sampler_.numberCameras(); ++camera) {
    std::vector<int> rays = sampler_.raysOf(camera);
    std::sort(rays.begin(), rays.end());  // the arrays are in random order
    if (rays.size() > kEnoughRays) rays.resize(kEnoughRays);
    ownRays_.push_back(data.arrays.subset(rays, {}));
  }
  best_ = noScores();
}

void StagedSampling::learn(const OwnScores& scores) {
  for (std::size_t i = 0; i < best_.size(); ++i) best_[i] = std::max(best_[i], scores[i]);
}

double StagedSampling::ownScore(std::size_t camera, const QueryPose& pose, double threshold) const {
  const PlainPose plain = toPlain(pose);
  const RayArrays rays = ownRays_[camera].rayArrays();
  return kernelsFor(plain).scoreRays(rays, plain, threshold * threshold, 0, rays.size).msac;
}

int StagedSampling::solve(const DrawnSample& sample, const SampleReader& reader, double threshold, RandomStream& random,
                          FocalPose* poses, OwnScores& scores) const {
  correspondences::RayMatch rays[kSix];
  for (int k = 0; k < kSix; ++k) rays[k] = reader.ray(sample.rays[k]);
  SixCorrespondences six;
  if (!six.setRays(rays)) return 0;
  OneFocalMotion motions[kMaxOneFocalMotions];
  const int found = oneFocalFundamental(six, motions);
  const int camera = sampler_.cameraOf(sample.rays[0]);
  const auto own = static_cast<std::size_t>(camera);
  int count = 0;
  for (int i = 0; i < found; ++i) {
    const QueryPose pose = poseOf(motions[i], rays[0].centre, six.imageScale, reader.distortion());
    const double score = ownScore(own, pose, threshold);
    scores[own] = std::max(scores[own], score);
    if (score < kWorthASeventh * std::max(best_[own], scores[own])) continue;
    for (int k = 0; k < kSeventhRays; ++k) {
      const int seventh = k == 0 ? sample.rays[kSix] : sampler_.drawOfOthers(camera, random);
      count += poseThroughRay(motions[i], rays[0].centre, six.imageScale, reader.ray(seventh), &poses[count]);
    }
  }
  return count;
}

}  // namespace robust
}  // namespace hybridgv
