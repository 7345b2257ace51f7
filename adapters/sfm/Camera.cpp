#include "hybridgv/adapters/sfm/Camera.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "CameraChecks.hpp"
#include "CheckArguments.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The parameters of every model, in one form.
struct Intrinsics {
  double fx = 1, fy = 1, cx = 0, cy = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0;
  bool removesDistortion = false;  // NVM: the formula maps distorted to undistorted
};

Intrinsics unpack(const Camera& camera) {
  const std::vector<double>& p = camera.parameters;
  switch (camera.model) {
    case CameraModel::SimplePinhole:
      return {p[0], p[0], p[1], p[2]};
    case CameraModel::Pinhole:
      return {p[0], p[1], p[2], p[3]};
    case CameraModel::SimpleRadial:
      return {p[0], p[0], p[1], p[2], p[3]};
    case CameraModel::Radial:
      return {p[0], p[0], p[1], p[2], p[3], p[4]};
    case CameraModel::OpenCV:
      return {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]};
    case CameraModel::NvmRadial:
      return {p[0], p[1], p[2], p[3], p[4], 0, 0, 0, true};
  }
  return {};
}

Intrinsics unpackChecked(const Camera& camera) {
  const std::string fault = findCameraFault(camera);
  if (!fault.empty()) throwInvalid("camera", fault);
  return unpack(camera);
}

// r -> g(r) = r (1 + k1 r^2 + k2 r^4) on [0, largestRadius], where it grows.
struct RadialMap {
  double k1, k2;

  double operator()(double r) const { return r * (1 + r * r * (k1 + r * r * k2)); }
  double derivative(double r) const { return 1 + r * r * (3 * k1 + r * r * 5 * k2); }

  // The square root of the smallest positive zero of g'(r) = 1 + 3 k1 s + 5 k2 s^2, s = r^2; infinite if there is none.
  double largestRadius() const {
    const double discriminant = 9 * k1 * k1 - 20 * k2;
    if (discriminant < 0) return kInfinity;
    // The zeros are 2 / (-3 k1 -+ sqrt(discriminant)), in this form also for k2 = 0; the larger denominator gives the smaller
    // one. It is -20 k2 / (3 k1 + sqrt(discriminant)), which does not cancel for k1 > 0.
    const double root = std::sqrt(discriminant);
    const double denominator = k1 > 0 ? -20 * k2 / (3 * k1 + root) : -3 * k1 + root;
    return denominator > 0 ? std::sqrt(2 / denominator) : kInfinity;
  }

  // The radius in [0, largestRadius] that is mapped onto `value`: Newton's method, kept inside a bracket. Negative if there is
  // none.
  double inverse(double value) const {
    double low = 0, high = largestRadius();
    if (high == kInfinity) {
      for (high = std::max(value, 1e-6); (*this)(high) < value && high < kInfinity; high *= 2) low = high;
      if (high == kInfinity) return -1;
    } else if (!((*this)(high) >= value)) {
      return -1;
    }
    double r = std::min(std::max(value, low), high);
    for (int i = 0; i < kMaxIterations; ++i) {
      const double residual = (*this)(r)-value;
      if (std::abs(residual) <= kTolerance * value) return r;
      (residual > 0 ? high : low) = r;
      const double newton = r - residual / derivative(r);
      const double next = newton > low && newton < high ? newton : (low + high) / 2;
      if (next == r) return r;  // the bracket is down to neighbouring numbers
      r = next;
    }
    return -1;
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kTolerance = 1e-15;
  static constexpr int kMaxIterations = 200;  // bisection alone needs about 60
};

Eigen::Vector3d scaledTo(double length, double x, double y, double factorOfZero) {
  const double r = std::hypot(x, y);
  const double factor = r > 0 ? length / r : factorOfZero;
  return {factor * x, factor * y, 1};
}

// The OpenCV formula of CameraModel.
Eigen::Vector3d applyDistortion(const Intrinsics& c, double x, double y) {
  const double r2 = x * x + y * y, radial = 1 + r2 * (c.k1 + r2 * c.k2);
  return {radial * x + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x), radial * y + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y, 1};
}

// d(applyDistortion) / d(x, y)
Eigen::Matrix2d distortionJacobian(const Intrinsics& c, double x, double y) {
  const double r2 = x * x + y * y, radial = 1 + r2 * (c.k1 + r2 * c.k2), slope = 2 * (c.k1 + 2 * c.k2 * r2);
  Eigen::Matrix2d result;
  const double mixed = slope * x * y + 2 * c.p1 * x + 2 * c.p2 * y;
  result << radial + slope * x * x + 2 * c.p1 * y + 6 * c.p2 * x, mixed,  //
      mixed, radial + slope * y * y + 6 * c.p1 * y + 2 * c.p2 * x;
  return result;
}

// The unfolded part of the formula's domain: around the axis, up to where the distorted image turns back.
bool isUnfolded(const Intrinsics& c, double x, double y) {
  return std::hypot(x, y) <= RadialMap{c.k1, c.k2}.largestRadius() && distortionJacobian(c, x, y).determinant() > 0;
}

// The point that applyDistortion maps onto (x, y): Newton's method with halved steps, started from the radial solution.
std::optional<Eigen::Vector3d> invertDistortion(const Intrinsics& c, double x, double y) {
  constexpr int kMaxIterations = 50;
  constexpr double kTolerance = 1e-13;
  const RadialMap radial{c.k1, c.k2};
  const double start = radial.inverse(std::hypot(x, y));
  if (c.p1 == 0 && c.p2 == 0) return start < 0 ? std::nullopt : std::optional<Eigen::Vector3d>(scaledTo(start, x, y, 1));
  Eigen::Vector3d point = scaledTo(start < 0 ? 0.99 * radial.largestRadius() : start, x, y, 1);
  const auto residualAt = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(applyDistortion(c, p[0], p[1]).head<2>() - Eigen::Vector2d(x, y));
  };
  Eigen::Vector2d residual = residualAt(point);
  for (int i = 0; i < kMaxIterations && residual.norm() > kTolerance * (1 + std::hypot(x, y)); ++i) {
    const Eigen::Vector2d step = distortionJacobian(c, point[0], point[1]).inverse() * residual;
    if (!step.allFinite()) return std::nullopt;
    double fraction = 1;
    Eigen::Vector3d next;
    do {
      next << point.head<2>() - fraction * step, 1;
      fraction /= 2;
    } while (!(residualAt(next).norm() < residual.norm()) && fraction > 1e-6);
    point = next;
    residual = residualAt(point);
  }
  const bool converged = residual.norm() <= kTolerance * (1 + std::hypot(x, y));
  return converged && isUnfolded(c, point[0], point[1]) ? std::optional<Eigen::Vector3d>(point) : std::nullopt;
}

}  // namespace

const char* toString(CameraModel model) {
  switch (model) {
    case CameraModel::SimplePinhole:
      return "SIMPLE_PINHOLE";
    case CameraModel::Pinhole:
      return "PINHOLE";
    case CameraModel::SimpleRadial:
      return "SIMPLE_RADIAL";
    case CameraModel::Radial:
      return "RADIAL";
    case CameraModel::OpenCV:
      return "OPENCV";
    case CameraModel::NvmRadial:
      return "NVM_RADIAL";
  }
  throwInvalid("model", "no such camera model: " + std::to_string(static_cast<int>(model)));
}

std::size_t parameterCount(CameraModel model) {
  switch (model) {
    case CameraModel::SimplePinhole:
      return 3;
    case CameraModel::Pinhole:
    case CameraModel::SimpleRadial:
      return 4;
    case CameraModel::Radial:
    case CameraModel::NvmRadial:
      return 5;
    case CameraModel::OpenCV:
      return 8;
  }
  return 0;
}

std::string findCameraFault(const Camera& camera) {
  const std::size_t count = parameterCount(camera.model);
  if (camera.parameters.size() != count)
    return std::string("model ") + toString(camera.model) + " has " + std::to_string(count) + " parameters, got " +
           std::to_string(camera.parameters.size());
  for (const double value : camera.parameters)
    if (!std::isfinite(value)) return "a parameter is not finite";
  const Intrinsics c = unpack(camera);
  if (!(c.fx > 0) || !(c.fy > 0)) return "the focal length must be positive, is " + std::to_string(std::min(c.fx, c.fy));
  return {};
}

double focalLength(const Camera& camera) { return unpackChecked(camera).fx; }

std::optional<Eigen::Vector3d> undistort(const Camera& camera, double x, double y) {
  const Intrinsics c = unpackChecked(camera);
  if (!std::isfinite(x) || !std::isfinite(y)) throwInvalid("(x, y)", "not finite");
  const double a = (x - c.cx) / c.fx, b = (y - c.cy) / c.fy;
  std::optional<Eigen::Vector3d> result;
  if (!c.removesDistortion)
    result = invertDistortion(c, a, b);
  else if (std::hypot(a, b) <= RadialMap{c.k1, 0}.largestRadius())
    result = applyDistortion(c, a, b);
  if (result) *result = Eigen::Vector3d(c.fx * (*result)[0], c.fx * (*result)[1], 1);
  return result && result->allFinite() ? result : std::nullopt;
}

std::optional<Eigen::Vector3d> distort(const Camera& camera, const Eigen::Vector3d& imagePoint) {
  const Intrinsics c = unpackChecked(camera);
  if (!imagePoint.allFinite() || imagePoint[2] == 0) throwInvalid("imagePoint", "must be finite (u, v, 1)");
  const double a = imagePoint[0] / imagePoint[2] / c.fx, b = imagePoint[1] / imagePoint[2] / c.fx;
  std::optional<Eigen::Vector3d> result;
  if (c.removesDistortion)
    result = invertDistortion(c, a, b);
  else if (isUnfolded(c, a, b))
    result = applyDistortion(c, a, b);
  if (result) *result = Eigen::Vector3d(c.fx * (*result)[0] + c.cx, c.fy * (*result)[1] + c.cy, 1);
  return result && result->allFinite() ? result : std::nullopt;
}

}  // namespace sfm
}  // namespace hybridgv
