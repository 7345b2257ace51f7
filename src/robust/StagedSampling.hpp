// Samples of six rays of one rig camera and one of another, in two stages.
//
// Six rays give the pose up to the distance of the query from the camera, and how many of the camera's other rays agree does not
// depend on that distance. So the rays of all the other cameras are asked only if many of its own agree, and then several seventh
// rays are tried, each of which takes a few nanoseconds: a wrong seventh ray does not spoil six good ones.
#pragma once

#include <vector>

#include "robust/QueryPose.hpp"
#include "robust/SampleReader.hpp"
#include "robust/SearchData.hpp"

namespace hybridgv {
namespace robust {

class StagedSampling {
 public:
  // How many seventh rays are tried.
  static constexpr int kSeventhRays = 8;
  // Of samples without outliers, the share from which the local optimization reaches the optimum.
  static constexpr double kYield = 0.4;
  // Largest number of poses of a sample.
  static constexpr int kMaxPoses = 9 * kSeventhRays;

  // The data must outlive the object.
  explicit StagedSampling(const SearchData& data);

  // The best score of a motion over the rays of its own camera, for each camera.
  using OwnScores = std::vector<double>;
  OwnScores noScores() const { return OwnScores(ownRays_.size(), 0); }
  // Tells those of all samples so far.
  void learn(const OwnScores& scores);

  // Writes the poses of a sample that deserve to be scored to `poses` and returns their number. Errors are compared with `threshold`.
  // Raises `scores`.
  int solve(const DrawnSample& sample, const SampleReader& reader, double threshold, RandomStream& random, FocalPose* poses,
            OwnScores& scores) const;

 private:
  double ownScore(std::size_t camera, const QueryPose& pose, double threshold) const;

  const Sampler& sampler_;
  std::vector<correspondences::CorrespondenceArrays> ownRays_;  // of each camera
  OwnScores best_;
};

}  // namespace robust
}  // namespace hybridgv
