// 4. Robust estimation: hybridRansac on matches of both kinds, a third of them wrong.
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <cstdio>
#include <random>

int main() {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  std::mt19937 generator(1);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); };
  // The query image: at (0.5, -0.2, -1), looking along +z, f = 900 px. Two rig cameras at the sides.
  const Vector3d position(0.5, -0.2, -1);
  const double focalLength = 900, imageNoisePx = 0.5;
  const std::vector<Vector3d> offsets{{-2, 0, 0}, {2, 0, 0}};
  const auto project = [&](const Vector3d& point) {
    const Vector3d y = point - position;
    return Vector3d(focalLength * y[0] / y[2] + uniform(-imageNoisePx, imageNoisePx),
                    focalLength * y[1] / y[2] + uniform(-imageNoisePx, imageNoisePx), 1);
  };
  std::vector<Vector3d> imagePoints2d2d, bearings, imagePoints2d3d, points;
  std::vector<int> cameras;
  for (int i = 0; i < 300; ++i) {
    const Vector3d point(uniform(-2, 3), uniform(-2, 2), uniform(4, 9));
    const Vector3d image = i % 3 ? project(point) : Vector3d(uniform(-400, 400), uniform(-300, 300), 1);  // every third is wrong
    if (i < 150) {  // only one rig camera saw it: a viewing ray
      cameras.push_back(i % 2);
      imagePoints2d2d.push_back(image);
      bearings.push_back(point - offsets[static_cast<std::size_t>(i % 2)]);
    } else {  // triangulated, with an error
      imagePoints2d3d.push_back(image);
      points.push_back(point + 0.02 * Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
    }
  }
  hybridgv::NoncentralHybridAdapter adapter(imagePoints2d2d, bearings, cameras, offsets,
                                            {Matrix3d::Identity(), Matrix3d::Identity()}, imagePoints2d3d, points);

  // [readme]
  adapter.setRigFocalLengths({1000, 1000});  // where known: the errors of the map's own image points are counted too
  const hybridgv::sac::HybridRansacResult result = hybridgv::sac::hybridRansac(adapter);  // the noise is found by itself
  if (!result.success) {
    std::printf("not localized: %s\n", toString(result.failureReason));
    return 1;
  }
  std::printf("focal length %.1f +- %.1f px, %d + %d inliers\n", result.pose.focalLength, result.focalLengthStandardDeviation,
              result.numberInliers2d2d, result.numberInliers2d3d);
  // [readme]
  std::printf("position %.3f %.3f %.3f, %d iterations, %.2f ms\n", result.pose.position[0], result.pose.position[1],
              result.pose.position[2], result.iterations, 1e3 * result.seconds);
  for (const auto& [solver, iterations] : result.iterationsPerSolver) std::printf("  %-6s %d\n", toString(solver), iterations);
}
