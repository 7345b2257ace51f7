// Samples that wait to be solved side by side.
#pragma once

#include <algorithm>
#include <array>

#include "robust/Sampler.hpp"
#include "robust/SolverChoice.hpp"

namespace hybridgv {
namespace robust {

// A sample on its way to poses.
struct Hypothesis {
  int number = 0;
  const Strategy* strategy = nullptr;
  DrawnSample sample = {};
  double distortion = 0;  // that was taken out of its image points
};

// Of one strategy whose solver takes several at once.
class GatheredSamples {
 public:
  int count() const { return count_; }
  bool isFull() const { return count_ == solvers::kSideBySide; }
  bool takes(const Strategy& strategy) const { return count_ == 0 || hypotheses_[0].strategy == &strategy; }
  const Hypothesis& operator[](int i) const { return hypotheses_[static_cast<std::size_t>(i)]; }

  // The points of the sample in pixels, and the focal length for which to solve it. Only where it is taken and they are not full.
  void add(const Hypothesis& hypothesis, const correspondences::PointMatch* points, double focalLength) {
    const int size = hypothesis.strategy->solver.points;
    std::copy(points, points + size, points_.begin() + count_ * size);
    focalLengths_[static_cast<std::size_t>(count_)] = focalLength;
    hypotheses_[static_cast<std::size_t>(count_++)] = hypothesis;
  }
  // The solutions of sample i begin at solutions[i * maxSolutions]; found[i] is their number. The samples stay, but their points are
  // used up: clear() follows.
  void solve(FocalPose* solutions, int* found) {
    if (count_ > 0)
      solvers::solveMany(hypotheses_[0].strategy->solver, points_.data(), focalLengths_.data(), count_, solutions, found);
  }
  void clear() { count_ = 0; }

 private:
  int count_ = 0;
  std::array<Hypothesis, solvers::kSideBySide> hypotheses_;
  std::array<correspondences::PointMatch, solvers::kSideBySide * kMaxSampleSize> points_;
  std::array<double, solvers::kSideBySide> focalLengths_{};
};

}  // namespace robust
}  // namespace hybridgv
