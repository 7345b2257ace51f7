#include "robust/PrincipalAxes.hpp"

#include <Eigen/Eigenvalues>

namespace hybridgv {
namespace robust {

PrincipalAxes::PrincipalAxes(const std::vector<Eigen::Vector3d>& positions) {
  const double count = static_cast<double>(positions.size());
  for (const Eigen::Vector3d& position : positions) centre += position / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& position : positions) scatter.noalias() += (position - centre) * (position - centre).transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  directions = solver.eigenvectors();
  deviations = (solver.eigenvalues() / count).cwiseMax(0).cwiseSqrt();
}

}  // namespace robust
}  // namespace hybridgv
