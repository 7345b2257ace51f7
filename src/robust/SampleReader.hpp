// Correspondences of a sample, as the minimal solvers take them.
#pragma once

#include "correspondences/CorrespondenceArrays.hpp"
#include "hybridgv/distortion.hpp"

namespace hybridgv {
namespace robust {

// Image points are undistorted by the division model.
class SampleReader {
 public:
  SampleReader(const correspondences::CorrespondenceArrays& arrays, double distortion)
      : arrays_(arrays), distortion_(distortion) {}

  correspondences::RayMatch ray(int i) const { return undistorted(arrays_.rays()[static_cast<std::size_t>(i)]); }
  correspondences::PointMatch point(int i) const { return undistorted(arrays_.points()[static_cast<std::size_t>(i)]); }
  double distortion() const { return distortion_; }

 private:
  template <class Match>
  Match undistorted(Match match) const {
    if (distortion_ == 0) return match;
    const Eigen::Vector3d point = undistort(distortion_, {match.u, match.v, 1});
    match.u = point[0];
    match.v = point[1];
    return match;
  }

  const correspondences::CorrespondenceArrays& arrays_;
  double distortion_;
};

}  // namespace robust
}  // namespace hybridgv
