// Random problems for OpenGV's gp3p, the yardstick of all times measured here: a rig of three cameras with offsets of about 0.3
// from its origin, points at a depth of about 6.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opengv/absolute_pose/NoncentralAbsoluteAdapter.hpp>
#include <optional>
#include <vector>

#include "Random.hpp"

namespace hybridgv {
namespace benchmarks {

// OpenGV's adapter keeps references to the arrays, so that they must stay where they are.
class Gp3pProblem {
 public:
  static constexpr int kCameras = 3;

  explicit Gp3pProblem(test::Random& random)
      : truthRotation_(Eigen::AngleAxisd(random.uniform(-0.5, 0.5), random.direction()).toRotationMatrix()) {
    const Eigen::Vector3d position = random.vector(-2, 2);
    for (int i = 0; i < kCameras; ++i) {
      offsets_.emplace_back(random.uniform(0.25, 0.35) * random.direction());
      rotations_.emplace_back(random.rotation());
      bearings_.emplace_back(random.direction());
      cameras_.push_back(i);
      const Eigen::Vector3d inViewpoint = offsets_.back() + rotations_.back() * (random.uniform(4, 8) * bearings_.back());
      points_.emplace_back(truthRotation_ * inViewpoint + position);
    }
    adapter_.emplace(bearings_, cameras_, points_, offsets_, rotations_);
  }
  Gp3pProblem(const Gp3pProblem&) = delete;
  Gp3pProblem& operator=(const Gp3pProblem&) = delete;

  const opengv::absolute_pose::NoncentralAbsoluteAdapter& adapter() const { return *adapter_; }
  const Eigen::Matrix3d& truthRotation() const { return truthRotation_; }

 private:
  Eigen::Matrix3d truthRotation_;
  opengv::translations_t offsets_;
  opengv::rotations_t rotations_;
  opengv::bearingVectors_t bearings_;
  std::vector<int> cameras_;
  opengv::points_t points_;
  // Not on the heap: in C++17 a program's `new` of OpenGV's adapters is not the one that its compiled `delete` belongs to.
  std::optional<opengv::absolute_pose::NoncentralAbsoluteAdapter> adapter_;
};

}  // namespace benchmarks
}  // namespace hybridgv
