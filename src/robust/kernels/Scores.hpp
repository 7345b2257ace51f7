// Errors of all correspondences, and the scores made of them.
#pragma once

#include "robust/kernels/BeyondInfinity.hpp"
#include "robust/kernels/Ranges.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

template <class Camera>
static void squaredPointErrors(const PointArrays& points, const PlainPose& plainPose, double* errors) {
  const typename Camera::Pose pose(plainPose);
  for (std::size_t i = 0; i < points.size; i += kWidth) {
    const typename Camera::Point point(points, i, pose);
    const DoubleMask valid = point.inFront & (point.squaredError < kInfinity);
    const Doubles squared = select<Doubles>(valid, point.squaredError, broadcast<Doubles>(kInfinity));
    store(errors + i, squared);
  }
}

// `reachesBeyondInfinity`: finite for those too that meet beyond infinity.
template <class Camera, bool reachesBeyondInfinity>
static void squaredRayErrors(const RayArrays& rays, const PlainPose& plainPose, double* errors) {
  const typename Camera::Pose pose(plainPose);
  const Doubles unknownPixel = broadcast<Doubles>(squaredPixelOfUnknown(plainPose));
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const typename Camera::Ray ray(rays, i, pose, unknownPixel);
    const Doubles error = ray.squaredError();
    const DoubleMask isFinite = error < kInfinity, inFront = ray.inFront() & isFinite;
    Doubles squared = select<Doubles>(inFront, error, broadcast<Doubles>(kInfinity));
    if (reachesBeyondInfinity && any(isFinite & ~inFront)) {
      const BeyondInfinity beyond(ray, pose);
      squared = select<Doubles>(isFinite & ~inFront & beyond.applies, error + beyond.squared(), squared);
    }
    store(errors + i, squared);
  }
}

// Sums up what is below the threshold; comparisons with NaN are false.
class ScoreSum {
 public:
  explicit ScoreSum(double squaredThreshold)
      : threshold_(broadcast<Doubles>(squaredThreshold)), perSquare_(broadcast<Doubles>(1 / squaredThreshold)) {}
  void add(DoubleMask valid, Doubles squaredError) {
    const DoubleMask inlier = valid & (squaredError < threshold_);
    gain_ += select<Doubles>(inlier, 1.0 - squaredError * perSquare_, Doubles{});
    inliers_ += select<Doubles>(inlier, broadcast<Doubles>(1), Doubles{});
  }
  Score score() const { return {sum(gain_), static_cast<int>(sum(inliers_))}; }

 private:
  Doubles threshold_, perSquare_, gain_{}, inliers_{};
};

template <class Camera>
static Score scorePoints(const PointArrays& points, const PlainPose& plainPose, double squaredThreshold, std::size_t begin,
                         std::size_t end) {
  const typename Camera::Pose pose(plainPose);
  ScoreSum result(squaredThreshold);
  forRange(begin, end, [&](std::size_t i, DoubleMask inRange) {
    const typename Camera::Point point(points, i, pose);
    result.add(point.inFront & inRange, point.squaredError);
  });
  return result.score();
}

template <class Camera>
static Score scoreRays(const RayArrays& rays, const PlainPose& plainPose, double squaredThreshold, std::size_t begin,
                       std::size_t end) {
  const typename Camera::Pose pose(plainPose);
  const Doubles unknownPixel = broadcast<Doubles>(squaredPixelOfUnknown(plainPose));
  ScoreSum result(squaredThreshold);
  forRange(begin, end, [&](std::size_t i, DoubleMask inRange) {
    const typename Camera::Ray ray(rays, i, pose, unknownPixel);
    result.add(ray.inFront() & inRange, ray.squaredError());
  });
  return result.score();
}

// Without branches: which errors are below which threshold cannot be foreseen.
static void countLevels(const double* squaredErrors, std::size_t size, double squaredThreshold, int counts[kLevels]) {
  double thresholds[kLevels];
  for (double& threshold : thresholds) {
    threshold = squaredThreshold;
    squaredThreshold /= 4;
  }
  DoubleMask below[kLevels] = {};  // a lane counts down
  std::size_t i = 0;
  for (; i + kWidth <= size; i += kWidth) {
    const Doubles errors = load<Doubles>(squaredErrors + i);
    for (int level = 0; level < kLevels; ++level) below[level] += errors < thresholds[level];
  }
  for (int level = 0; level < kLevels; ++level) {
    int count = 0;
    for (int lane = 0; lane < kWidth; ++lane) count -= static_cast<int>(below[level][lane]);
    for (std::size_t k = i; k < size; ++k) count += squaredErrors[k] < thresholds[level];
    counts[level] = count;
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
