#include "PlaneDistortion.hpp"

#include <Eigen/LU>
#include <cmath>

namespace hybridgv {
namespace sfm {

Eigen::Vector2d PlaneDistortion::evaluate(const Eigen::Vector2d& point) const {
  const double x = point[0], y = point[1], s = x * x + y * y, g = radial.factor(s);
  return {g * x + 2 * p1 * x * y + p2 * (s + 2 * x * x) + s * (sx1 + s * sx2),
          g * y + p1 * (s + 2 * y * y) + 2 * p2 * x * y + s * (sy1 + s * sy2)};
}

Eigen::Matrix2d PlaneDistortion::jacobian(const Eigen::Vector2d& point) const {
  const double x = point[0], y = point[1], s = x * x + y * y;
  const double g = radial.factor(s), slope = 2 * radial.factorSlope(s);
  const double mixed = slope * x * y + 2 * p1 * x + 2 * p2 * y;
  const double prismX = 2 * (sx1 + 2 * sx2 * s), prismY = 2 * (sy1 + 2 * sy2 * s);
  Eigen::Matrix2d result;
  result << g + slope * x * x + 2 * p1 * y + 6 * p2 * x + prismX * x, mixed + prismX * y,  //
      mixed + prismY * x, g + slope * y * y + 6 * p1 * y + 2 * p2 * x + prismY * y;
  return result;
}

bool PlaneDistortion::isUnfolded(const Eigen::Vector2d& point) const {
  constexpr int kSteps = 16;
  if (!(point.norm() <= radial.largestRadius())) return false;
  if (isRadial()) return true;
  for (int i = 1; i <= kSteps; ++i)
    if (!(jacobian(i / static_cast<double>(kSteps) * point).determinant() > 0)) return false;
  return true;
}

std::optional<Eigen::Vector2d> PlaneDistortion::apply(const Eigen::Vector2d& point) const {
  if (!isUnfolded(point)) return std::nullopt;
  return evaluate(point);
}

// Newton's method with halved steps, started from the radial solution.
std::optional<Eigen::Vector2d> PlaneDistortion::invert(const Eigen::Vector2d& image) const {
  constexpr int kMaxIterations = 50;
  constexpr double kTolerance = 1e-13;
  const double distance = std::hypot(image[0], image[1]);
  const double start = radial.inverse(distance);
  const auto scaledTo = [&](double length) -> Eigen::Vector2d { return distance > 0 ? length / distance * image : image; };
  if (isRadial()) return start < 0 ? std::nullopt : std::optional<Eigen::Vector2d>(scaledTo(start));
  Eigen::Vector2d point = scaledTo(start < 0 ? 0.99 * radial.largestRadius() : start);
  Eigen::Vector2d residual = evaluate(point) - image;
  for (int i = 0; i < kMaxIterations && residual.norm() > kTolerance * (1 + distance); ++i) {
    const Eigen::Vector2d step = jacobian(point).inverse() * residual;
    if (!step.allFinite()) return std::nullopt;
    double fraction = 1;
    Eigen::Vector2d next;
    do {
      next = point - fraction * step;
      fraction /= 2;
    } while (!((evaluate(next) - image).norm() < residual.norm()) && fraction > 1e-6);
    point = next;
    residual = evaluate(point) - image;
  }
  const bool converged = residual.norm() <= kTolerance * (1 + distance);
  return converged && isUnfolded(point) ? std::optional<Eigen::Vector2d>(point) : std::nullopt;
}

}  // namespace sfm
}  // namespace hybridgv
