// 8. How uncertain is the position, and does another measurement of it agree?
//    usage: 08_uncertainty [MAP]
#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <Eigen/Dense>
#include <cstdio>
#include <exception>

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The position's block of the covariance, with directions in the map's frame.
Matrix3d positionCovariance(const hybridgv::sac::HybridRansacResult& result) {
  using Matrix7d = Eigen::Matrix<double, 7, 7, Eigen::RowMajor>;
  return Eigen::Map<const Matrix7d>(result.covariance.data()).block<3, 3>(3, 3);
}

// [readme]
// 99 % of the errors lie in the ellipsoid with these half axes, along the columns of eigenvectors().
void printEllipsoid(const Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(covariance);
  const Vector3d halfAxes = 3.37 * axes.eigenvalues().cwiseSqrt();
  const Vector3d worst = axes.eigenvectors().col(2);
  std::printf("half axes %.4f %.4f %.4f, the longest along %.2f %.2f %.2f\n", halfAxes[0], halfAxes[1], halfAxes[2], worst[0],
              worst[1], worst[2]);
}

// Gating: two right measurements of one position are farther apart than this in 1 of 100 cases (three degrees of freedom).
bool agree(const Vector3d& difference, const Matrix3d& covariance, const Matrix3d& otherCovariance) {
  const Matrix3d sum = covariance + otherCovariance;
  return difference.dot(sum.ldlt().solve(difference)) < 11.34;
}
// [readme]

int main(int argc, char** argv) try {
  const hybridgv::sfm::SparseModel map = hybridgv::sfm::readModel(argc > 1 ? argv[1] : HYBRIDGV_DEFAULT_MAP);
  const hybridgv::sfm::LocalizationProblem problem = hybridgv::sfm::makeLocalizationProblem(map, 0);
  const hybridgv::sac::HybridRansacResult result = hybridgv::sac::hybridRansac(problem.adapter);
  if (!result.success) {
    std::printf("%s: not localized: %s\n", problem.imageName.c_str(), toString(result.failureReason));
    return 1;
  }
  const Matrix3d covariance = positionCovariance(result);
  printEllipsoid(covariance);

  // Another receiver, with a standard deviation of 0.1 in every direction: where the image was taken according to the map, and one unit
  // beside it.
  const Matrix3d other = 0.01 * Matrix3d::Identity();
  for (const double offset : {0., 1.}) {
    const Vector3d measured = problem.reference->position + Vector3d(offset, 0, 0);
    const bool isGood = agree(measured - result.pose.position, covariance, other);
    std::printf("measured %.1f beside it: %s\n", offset, isGood ? "agrees" : "does not agree");
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
