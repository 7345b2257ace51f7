// 3. A hybrid solver inside OpenGV's own loop: opengv::sac::Ransac with H13f, matches of both kinds, a fifth of them wrong.
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/sac_problems/hybrid_pose/HybridPoseSacProblem.hpp>

#include <cstdio>
#include <opengv/sac/Ransac.hpp>
#include <random>

int main() {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  std::mt19937 generator(1);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); };
  const Vector3d position(0.5, -0.2, -1), offset(2, 0, 0);  // of the query and of the only rig camera; both look along +z
  const double focalLength = 900;
  std::vector<Vector3d> imagePoints2d2d, bearings, imagePoints2d3d, points;
  for (int i = 0; i < 200; ++i) {
    const Vector3d point(uniform(-2, 3), uniform(-2, 2), uniform(4, 9)), y = point - position;
    Vector3d image(focalLength * y[0] / y[2], focalLength * y[1] / y[2], 1);
    if (i % 5 == 0) image = Vector3d(uniform(-400, 400), uniform(-300, 300), 1);
    if (i < 100) {
      imagePoints2d2d.push_back(image);
      bearings.push_back(point - offset);
    } else {
      imagePoints2d3d.push_back(image);
      points.push_back(point);
    }
  }
  const hybridgv::NoncentralHybridAdapter adapter(imagePoints2d2d, bearings, std::vector<int>(bearings.size(), 0), {offset},
                                                  {Matrix3d::Identity()}, imagePoints2d3d, points);

  // [readme]
  using Problem = hybridgv::sac_problems::hybrid_pose::HybridPoseSacProblem;
  opengv::sac::Ransac<Problem> ransac;
  ransac.sac_model_ = std::make_shared<Problem>(adapter, hybridgv::Solver::H13f, /*reprojection px*/ 4.0, /*epipolar px*/ 2.0);
  ransac.threshold_ = 1.0;  // the problem divides every error by its own threshold
  if (!ransac.computeModel()) return 1;
  hybridgv::FocalPose refined;
  ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
  // [readme]
  std::printf("focal length %.3f px, position %.4f %.4f %.4f, %zu inliers of 200, %d iterations\n", refined.focalLength,
              refined.position[0], refined.position[1], refined.position[2], ransac.inliers_.size(), ransac.iterations_);
}
