// 6. A query image as it is: focal length and lens distortion are both unknown.
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <cmath>
#include <cstdio>
#include <random>

int main() {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  std::mt19937 generator(1);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); };
  // The query image: 1200 x 900 px, at (0.5, -0.2, -1), looking along +z, f = 900 px, k1 = -0.15 (COLMAP's SIMPLE_RADIAL).
  const Vector3d position(0.5, -0.2, -1);
  const double focalLength = 900, k1 = -0.15, width = 1200, height = 900;
  const std::vector<Vector3d> offsets{{-2, 0, 0}, {2, 0, 0}};
  std::vector<Vector3d> imagePoints2d2d, bearings, imagePoints2d3d, points;
  std::vector<int> cameras;
  while (imagePoints2d2d.size() + imagePoints2d3d.size() < 300) {
    const Vector3d point(uniform(-6, 7), uniform(-5, 5), uniform(4, 9)), y = point - position;
    const double u = y[0] / y[2], v = y[1] / y[2], f = focalLength * (1 + k1 * (u * u + v * v));
    // Raw pixels relative to the principal point, which is the middle of the image if it is not known better.
    Vector3d image(f * u + uniform(-1, 1), f * v + uniform(-1, 1), 1);
    if (std::abs(image[0]) > width / 2 || std::abs(image[1]) > height / 2) continue;
    if (uniform(0, 1) < 0.3) image = Vector3d(uniform(-width / 2, width / 2), uniform(-height / 2, height / 2), 1);  // wrong
    if (uniform(0, 1) < 0.5) {
      cameras.push_back(static_cast<int>(imagePoints2d2d.size()) % 2);
      imagePoints2d2d.push_back(image);
      bearings.push_back(point - offsets[static_cast<std::size_t>(cameras.back())]);
    } else {
      imagePoints2d3d.push_back(image);
      points.push_back(point);
    }
  }
  hybridgv::NoncentralHybridAdapter adapter(imagePoints2d2d, bearings, cameras, offsets,
                                            {Matrix3d::Identity(), Matrix3d::Identity()}, imagePoints2d3d, points);
  adapter.setRigFocalLengths({1000, 1000});

  const hybridgv::sac::HybridRansacResult pinhole = hybridgv::sac::hybridRansac(adapter);
  std::printf("distortion ignored: focal length %.1f +- %.1f px\n", pinhole.pose.focalLength,
              pinhole.focalLengthStandardDeviation);

  // [readme]
  hybridgv::sac::HybridRansacOptions options;
  options.queryCamera = hybridgv::sac::QueryCamera::Radial;  // image points are raw pixels minus the principal point
  options.imageRadiusPx = std::hypot(width, height) / 2;
  const hybridgv::sac::HybridRansacResult result = hybridgv::sac::hybridRansac(adapter, options);
  std::printf("distortion found: focal length %.1f +- %.1f px, k1 %.3f +- %.3f\n", result.simpleRadialFocalLength,
              result.focalLengthStandardDeviation, result.simpleRadialK1, result.simpleRadialK1StandardDeviation);
  // [readme]
  if (!result.success) std::printf("not localized: %s\n", toString(result.failureReason));
  return result.success ? 0 : 1;
}
