// A fuzzer's sample as an adapter, and how a fuzzer reports a fault.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "SampleBytes.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace fuzz {

// Hands the doubles on without looking at them.
class RawAdapter : public hybrid_pose::HybridAdapterBase {
 public:
  explicit RawAdapter(const Sample& sample) : sample_(sample) {}
  std::size_t getNumberCorrespondences2d2d() const override { return sample_.rays.size(); }
  Eigen::Vector3d getImagePoint2d2d(std::size_t i) const override { return {sample_.rays[i].u, sample_.rays[i].v, 1}; }
  Eigen::Vector3d getBearingVector(std::size_t i) const override { return sample_.rays[i].direction; }
  int getCamIndex(std::size_t i) const override { return sample_.rays[i].camera; }
  Eigen::Vector3d getCamOffset(std::size_t i) const override { return sample_.rays[i].centre; }
  Eigen::Matrix3d getCamRotation(std::size_t) const override { return Eigen::Matrix3d::Identity(); }
  std::size_t getNumberCorrespondences2d3d() const override { return sample_.points.size(); }
  Eigen::Vector3d getImagePoint2d3d(std::size_t i) const override { return {sample_.points[i].u, sample_.points[i].v, 1}; }
  Eigen::Vector3d getPoint(std::size_t i) const override { return sample_.points[i].point; }

 private:
  const Sample& sample_;
};

[[noreturn]] inline void reportFault(const char* promise) {
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

inline bool isFinite(const Sample& sample) {
  const auto rayIsFinite = [](const solvers::RayMatch& ray) {
    return std::isfinite(ray.u) && std::isfinite(ray.v) && ray.centre.allFinite() && ray.direction.allFinite();
  };
  const auto pointIsFinite = [](const solvers::PointMatch& match) {
    return std::isfinite(match.u) && std::isfinite(match.v) && match.point.allFinite();
  };
  return std::all_of(sample.rays.begin(), sample.rays.end(), rayIsFinite) &&
         std::all_of(sample.points.begin(), sample.points.end(), pointIsFinite);
}

}  // namespace fuzz
}  // namespace hybridgv
