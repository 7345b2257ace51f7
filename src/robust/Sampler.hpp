// Random minimal samples, and the probabilities that they contain inliers only.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "math/RandomStream.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace robust {

using math::RandomStream;

using solvers::kMaxSampleSize;
using solvers::RayDraw;

struct SampleSize {
  int rays, points;
  RayDraw rayDraw;
  int triesOfLastRay = 1;  // of RayDraw::AllButOne: a sample is good if one of so many last rays is
};

// Which correspondences are in a sample.
struct DrawnSample {
  int rays[kMaxSampleSize], points[kMaxSampleSize];
};

// Inliers of a pose, by what a sample can be drawn from.
struct InlierCounts {
  int points = 0, rays = 0;
  std::vector<int> raysPerCamera;  // the rig cameras that have rays, by increasing number
};

class Sampler {
 public:
  // Of nothing.
  Sampler() = default;
  // cameraOfRay: the rig camera of each ray (any numbers). Correspondences are drawn from the front of rayOrder and pointOrder
  // first where growingPools is set: the pool of sample t holds the first N (t / kGrowth)^(1/m) of N, m the size of the sample.
  Sampler(const std::vector<int>& cameraOfRay, std::vector<int> rayOrder, std::vector<int> pointOrder, bool growingPools);

  // Whether there are enough correspondences.
  bool canDraw(const SampleSize& size) const;
  // The `number`-th sample (1, 2, ..), in a time that does not depend on the numbers of correspondences and cameras (but for a
  // logarithm), without an allocation. Needs canDraw(size).
  DrawnSample draw(const SampleSize& size, int number, RandomStream& random) const;
  // Probability that a sample drawn from everything (no growing pools) has inliers only: exact.
  double allInlierProbability(const SampleSize& size, const InlierCounts& inliers) const;

  int numberRays() const { return static_cast<int>(rayOrder_.size()); }
  int numberRays(std::size_t camera) const { return static_cast<int>(raysOfCamera_[camera].size()); }
  int numberPoints() const { return static_cast<int>(pointOrder_.size()); }
  int numberCameras() const { return static_cast<int>(raysOfCamera_.size()); }
  // The camera of a ray, and the rays of a camera; a number below numberCameras().
  int cameraOf(int ray) const { return cameraOfRay_[static_cast<std::size_t>(ray)]; }
  const std::vector<int>& raysOf(int camera) const { return raysOfCamera_[static_cast<std::size_t>(camera)]; }
  // Any ray of another camera; there must be one.
  int drawOfOthers(int camera, RandomStream& random) const;
  // Inliers among rays and points by their masks.
  InlierCounts count(const std::vector<char>& inlierRays, const std::vector<char>& inlierPoints) const;

 private:
  static constexpr double kGrowth = 10000;

  // Those cameras that have a certain number of rays at least, by increasing number, with the number of rays of all up to each.
  struct CameraList {
    std::vector<int> cameras, raysUpTo;
  };
  void listCameras();
  const CameraList& camerasWith(int rays) const { return camerasWith_[static_cast<std::size_t>(rays)]; }

  int poolSize(int available, int sampleSize, int number) const;
  // Returns the camera, a place in raysOfCamera_.
  int drawOneCamera(int count, int number, RandomStream& random, int* sample) const;
  void drawAllButOne(int count, int number, RandomStream& random, int* sample) const;
  void drawSpread(int count, int number, RandomStream& random, int* sample) const;
  template <class Probability>
  double meanOverCameras(int count, Probability probability) const;
  double oneCameraProbability(int count, const InlierCounts& inliers) const;
  double allButOneProbability(int count, int triesOfLast, const InlierCounts& inliers) const;
  double spreadProbability(int count, const InlierCounts& inliers) const;

  std::vector<int> rayOrder_, pointOrder_;
  std::vector<std::vector<int>> raysOfCamera_;
  std::vector<int> cameraOfRay_;
  std::array<CameraList, kMaxSampleSize + 1> camerasWith_;  // by the least number of rays
  bool growingPools_ = false;
};

// Probability that `drawn` of `total`, without replacement, are all among `good` ones.
double hypergeometricAll(int total, int good, int drawn);

}  // namespace robust
}  // namespace hybridgv
