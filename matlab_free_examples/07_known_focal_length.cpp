// 7. A calibrated query: the focal length is known, and so fewer matches are enough.
#include <hybridgv/absolute_pose/methods.hpp>
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
  // The query image: 1200 x 900 px, at (0.5, -0.2, -1), looking along +z, f = 900 px. Twelve matches of each kind, a third wrong.
  const Vector3d position(0.5, -0.2, -1);
  const double focalLength = 900, width = 1200, height = 900;
  const std::vector<Vector3d> offsets{{-2, 0, 0}, {2, 0, 0}};
  std::vector<Vector3d> imagePoints2d2d, bearings, imagePoints2d3d, points;
  std::vector<int> cameras;
  while (imagePoints2d3d.size() < 12) {
    const Vector3d point(uniform(-6, 7), uniform(-5, 5), uniform(4, 9)), y = point - position;
    Vector3d image(focalLength * y[0] / y[2] + uniform(-1, 1), focalLength * y[1] / y[2] + uniform(-1, 1), 1);
    if (std::abs(image[0]) > width / 2 || std::abs(image[1]) > height / 2) continue;
    const bool isRay = imagePoints2d2d.size() < 12;
    const std::size_t number = isRay ? imagePoints2d2d.size() : imagePoints2d3d.size();
    if (number % 3 == 0) image = Vector3d(uniform(-width / 2, width / 2), uniform(-height / 2, height / 2), 1);  // wrong
    if (isRay) {
      cameras.push_back(static_cast<int>(number) % 2);
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

  // The minimal solver alone: three right points.
  std::printf("p3p: %zu poses\n", hybridgv::absolute_pose::p3p(adapter, focalLength, {1, 2, 4}).size());

  // [readme]
  hybridgv::sac::HybridRansacOptions options;
  options.knownFocalLengthPx = 900;  // of a calibrated camera; focalLengthPriorPx is for one that is known roughly
  const hybridgv::sac::HybridRansacResult result = hybridgv::sac::hybridRansac(adapter, options);
  // [readme]
  if (!result.success) {
    std::printf("not localized: %s\n", toString(result.failureReason));
    return 1;
  }
  std::printf("position %.2f %.2f %.2f, %d + %d inliers\n", result.pose.position[0], result.pose.position[1],
              result.pose.position[2], result.numberInliers2d2d, result.numberInliers2d3d);
}
