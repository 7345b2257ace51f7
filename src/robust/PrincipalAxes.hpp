// In which directions positions extend, and how far.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hybridgv {
namespace robust {

// Of at least one position. The directions are columns, orthonormal, those along which the standard deviations are smallest first.
struct PrincipalAxes {
  explicit PrincipalAxes(const std::vector<Eigen::Vector3d>& positions);

  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), deviations;
  Eigen::Matrix3d directions;
};

}  // namespace robust
}  // namespace hybridgv
