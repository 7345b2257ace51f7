#include "ClosedForms.hpp"

#include <cmath>

namespace hybridgv {
namespace sfm {
namespace {

const double kPi = std::acos(-1.0);

double across(const Eigen::Vector3d& point) { return std::hypot(point[0], point[1]); }

// (x, y) stretched to `length`; `factorOfZero` where it has no direction.
Eigen::Vector2d stretched(double x, double y, double length, double factorOfZero) {
  const double r = std::hypot(x, y);
  return Eigen::Vector2d(x, y) * (r > 0 ? length / r : factorOfZero);
}

}  // namespace

MaybeImage equidistantImage(const Eigen::Vector3d& point) {
  const double r = across(point);
  if (r == 0 && !(point[2] > 0)) return std::nullopt;
  return stretched(point[0], point[1], std::atan2(r, point[2]), 1);
}

MaybeRay equidistantRay(const Eigen::Vector2d& image) {
  const double angle = std::hypot(image[0], image[1]);
  if (!(angle <= kPi)) return std::nullopt;
  Eigen::Vector3d ray;
  ray << stretched(image[0], image[1], std::sin(angle), 1), std::cos(angle);
  return ray;
}

MaybeImage fovImage(const Eigen::Vector3d& point, double angle) {
  if (!(point[2] > 0)) return std::nullopt;
  const double x = point[0] / point[2], y = point[1] / point[2];
  if (angle == 0) return Eigen::Vector2d(x, y);
  const double slope = 2 * std::tan(angle / 2);
  return stretched(x, y, std::atan(slope * std::hypot(x, y)) / angle, slope / angle);
}

MaybeRay fovRay(const Eigen::Vector2d& image, double angle) {
  if (angle == 0) return Eigen::Vector3d(image[0], image[1], 1);
  const double distorted = std::hypot(image[0], image[1]) * std::abs(angle);
  if (!(distorted < kPi / 2)) return std::nullopt;
  const double slope = 2 * std::tan(std::abs(angle) / 2);
  Eigen::Vector3d ray;
  ray << stretched(image[0], image[1], std::sin(distorted), std::abs(angle)), slope * std::cos(distorted);
  return ray;
}

MaybeImage divisionImage(const Eigen::Vector3d& point, double k) {
  const double z = point[2], r = across(point), radicand = z * z - 4 * k * r * r;
  if (!(radicand >= 0) || (k >= 0 && !(z > 0))) return std::nullopt;
  const double root = std::sqrt(radicand);
  // For z < 0 (and so k < 0) the sum z + root cancels; it is the same as -4 k r^2 / (root - z).
  const double denominator = z >= 0 ? z + root : -4 * k * r * r / (root - z);
  if (!(denominator > 0)) return std::nullopt;
  return Eigen::Vector2d(2 / denominator * point.head<2>());
}

MaybeRay divisionRay(const Eigen::Vector2d& image, double k) {
  const double squared = image.squaredNorm();
  if (k > 0 && !(k * squared <= 1)) return std::nullopt;  // the image of the rays at r = 1 / (2 sqrt(k)), beyond which nothing is
  return Eigen::Vector3d(image[0], image[1], 1 + k * squared);
}

MaybeImage eucmImage(const Eigen::Vector3d& point, double alpha, double beta) {
  const double r = across(point), z = point[2], rho = std::sqrt(beta * r * r + z * z);
  const double narrow = alpha > 0.5 ? (1 - alpha) / alpha : alpha / (1 - alpha);
  const double denominator = alpha * rho + (1 - alpha) * z;
  if (!(z > -narrow * rho) || !(denominator > 0)) return std::nullopt;
  return Eigen::Vector2d(point.head<2>() / denominator);
}

MaybeRay eucmRay(const Eigen::Vector2d& image, double alpha, double beta) {
  const double squared = beta * image.squaredNorm();
  const double radicand = 1 - (2 * alpha - 1) * squared;
  if (!(radicand >= 0)) return std::nullopt;
  const double denominator = alpha * std::sqrt(radicand) + 1 - alpha;
  const double numerator = 1 - alpha * alpha * squared;
  return Eigen::Vector3d(image[0], image[1], denominator > 0 ? numerator / denominator : 0);
}

MaybeImage sphereImage(const Eigen::Vector3d& point) {
  if (point.isZero(0)) return std::nullopt;
  return Eigen::Vector2d(std::atan2(point[0], point[2]), std::atan2(point[1], std::hypot(point[0], point[2])));
}

MaybeRay sphereRay(const Eigen::Vector2d& image) {
  constexpr double kRounding = 1e-12;
  if (std::abs(image[0]) > kPi * (1 + kRounding) || std::abs(image[1]) > kPi / 2 * (1 + kRounding)) return std::nullopt;
  const double level = std::cos(image[1]);
  return Eigen::Vector3d(level * std::sin(image[0]), std::sin(image[1]), level * std::cos(image[0]));
}

}  // namespace sfm
}  // namespace hybridgv
