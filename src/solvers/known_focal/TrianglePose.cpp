#include "solvers/known_focal/TrianglePose.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solvers/known_focal/Bearing.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace {

// Sine of the angle at a point of a triangle that counts as collinear.
constexpr double kCollinear = 1e-12;
constexpr double kImageTolerance = 1e-7;

// Sine of the angle at a point of a triangle whose duals have lost digits, and a product of sides whose square is not small.
constexpr double kThin = 1e-2, kShort = 1e-50;

bool areParallel(const Eigen::Vector3d& product, double squareOfBoth) {
  return !(product.squaredNorm() > kCollinear * kCollinear * squareOfBoth);
}

// Shorter or longer, where the square of the length would be beyond the doubles.
Eigen::Vector3d moderate(const Eigen::Vector3d& v) {
  const double square = v.squaredNorm();
  return square > 1e-200 && square < 1e200 ? v : Eigen::Vector3d(v / v.cwiseAbs().maxCoeff());
}

// Orthonormal columns: along a, in the plane of a and b, normal to it. False if these are parallel.
bool makeFrame(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Matrix3d& frame) {
  const Eigen::Vector3d first = moderate(a).normalized(), second = moderate(b), product = first.cross(second);
  if (areParallel(product, second.squaredNorm())) return false;
  // Of vectors that are almost parallel the product is perpendicular to neither, by as much as has cancelled in it.
  const Eigen::Vector3d normal = (product - first.dot(product) * first).normalized();
  frame << first, normal.cross(first), normal;
  return true;
}

// A matrix that is almost a rotation becomes one to rounding: 1 / |v| is 3/2 - |v|^2 / 2, to the square of the small difference.
bool orthonormalize(Eigen::Matrix3d& R) {
  constexpr double kSmall = 1e-8;
  Eigen::Vector3d first = R.col(0), second = R.col(1);
  const double firstSquare = first.squaredNorm(), secondSquare = second.squaredNorm(), inner = first.dot(second);
  if (!(std::abs(firstSquare - 1) < kSmall && std::abs(secondSquare - 1) < kSmall && std::abs(inner) < kSmall)) return false;
  first *= 1.5 - 0.5 * firstSquare;
  second = (1.5 - 0.5 * secondSquare) * second - inner * first;
  R << first, second, first.cross(second);
  return true;
}

}  // namespace

bool TrianglePose::set(const PointMatch* points) {
  points_ = points;
  imageScale_ = 0;
  for (int i = 0; i < 3; ++i) {
    bearings_[i] = bearingOf(points[i].u, points[i].v);
    imageScale_ = std::max({imageScale_, std::abs(points[i].u), std::abs(points[i].v)});
  }
  Eigen::Vector3d a = points[1].point - points[0].point, b = points[2].point - points[0].point;
  const double extent = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  if (!(extent > 0) || !std::isfinite(extent)) return false;
  const bool isModerate = extent > 1e-100 && extent < 1e100;  // its square is a double
  if (!isModerate) {
    a /= extent;
    b /= extent;
  }
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = (b - a).squaredNorm(), sum = aa + bb + cc, root = std::sqrt(sum);
  const double inverse = 1 / sum, inverseRoot = inverse * root;
  unit_ = isModerate ? root : extent * root;
  fromFirst_[0].setZero();
  fromFirst_[1] = a * inverseRoot;
  fromFirst_[2] = b * inverseRoot;
  squaredSides_[0] = aa * inverse;
  squaredSides_[1] = bb * inverse;
  squaredSides_[2] = cc * inverse;
  setDuals();
  Eigen::Matrix3d frame;
  return std::isfinite(unit_) && (!isThin_ || makeFrame(fromFirst_[1], fromFirst_[2], frame));
}

// With the vectors a, b of both sides, n = a x b and |n|^2 = |a|^2 |b|^2 - (a.b)^2.
void TrianglePose::setDuals() {
  const Eigen::Vector3d &a = fromFirst_[1], &b = fromFirst_[2], n = a.cross(b);
  const double aa = squaredSides_[0], bb = squaredSides_[1], ab = a.dot(b), nn = n.squaredNorm(), inverse = 1 / nn;
  isThin_ = !(aa * bb > kShort && nn > kThin * kThin * aa * bb);
  duals_ << (inverse * bb) * a - (inverse * ab) * b, (inverse * aa) * b - (inverse * ab) * a, inverse * n;
}

bool TrianglePose::set(const Eigen::Vector3d& depths, FocalPose& pose) const {
  const Eigen::Vector3d first = depths[0] * bearings_[0];
  if (!setRotation(depths[1] * bearings_[1] - first, depths[2] * bearings_[2] - first, pose.rotation)) return false;
  if (!isMet(pose.rotation, first)) return false;
  pose.position = points_[0].point - unit_ * (pose.rotation * first);
  pose.focalLength = 1;
  return true;
}

// The rotation is that of the duals, as the triangle is seen to its own. Where that is not one to rounding, of frames that are orthonormal in any case.
bool TrianglePose::setRotation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Matrix3d& rotation) const {
  if (!isThin_) {
    rotation.noalias() = duals_.col(0) * a.transpose() + duals_.col(1) * b.transpose() + duals_.col(2) * a.cross(b).transpose();
    if (orthonormalize(rotation)) return true;
  }
  Eigen::Matrix3d frame, seen;
  if (!makeFrame(fromFirst_[1], fromFirst_[2], frame) || !makeFrame(a, b, seen)) return false;
  rotation.noalias() = frame * seen.transpose();
  return true;
}

bool TrianglePose::isMet(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& first) const {
  for (int i = 1; i < 3; ++i) {
    const Eigen::Vector3d y = rotation.transpose() * fromFirst_[i] + first;
    const double allowed = kImageTolerance * imageScale_ * y[2];
    if (!(std::abs(y[0] - points_[i].u * y[2]) <= allowed && std::abs(y[1] - points_[i].v * y[2]) <= allowed)) return false;
  }
  return true;
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv
