#include "Triangulation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridgv {
namespace sfm {
namespace {

// sum_i |(I - d_i d_i^T) (X - c_i)|^2 -> min
Eigen::Vector3d nearestToRays(const std::vector<View>& views) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const View& view : views) {
    const Eigen::Vector3d d = view.rotation * view.direction();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - d * d.transpose();
    A += across;
    b += across * view.position;
  }
  return A.ldlt().solve(b);
}

// The residuals' normal equations at `point`; returns the sum of squares, infinite if a camera does not have the point in front.
double linearize(const std::vector<View>& views, const Eigen::Vector3d& point, Eigen::Matrix3d& JtJ, Eigen::Vector3d& Jtr,
                 double& largestSquaredError) {
  double sum = largestSquaredError = 0;
  JtJ.setZero();
  Jtr.setZero();
  for (const View& view : views) {
    const Eigen::Vector3d p = view.rotation.transpose() * (point - view.position);
    if (!(p[2] > 0)) return std::numeric_limits<double>::infinity();
    const double x = p[0] / p[2], y = p[1] / p[2], scale = view.focalLength / p[2];
    const Eigen::Vector2d residual(view.focalLength * x - view.u, view.focalLength * y - view.v);
    Eigen::Matrix<double, 2, 3> J;
    J << scale, 0, -scale * x, 0, scale, -scale * y;
    J *= view.rotation.transpose();
    JtJ += J.transpose() * J;
    Jtr += J.transpose() * residual;
    sum += residual.squaredNorm();
    largestSquaredError = std::max(largestSquaredError, residual.squaredNorm());
  }
  return sum;
}

}  // namespace

Eigen::Vector3d View::direction() const { return Eigen::Vector3d(u, v, focalLength).stableNormalized(); }

Triangulation triangulate(const std::vector<View>& views) {
  constexpr int kMaxIterations = 20;
  constexpr double kConverged = 1e-14;  // relative decrease of the sum of squares
  Triangulation result;
  result.point = nearestToRays(views);
  Eigen::Matrix3d JtJ, nextJtJ;
  Eigen::Vector3d Jtr, nextJtr;
  double error = 0, nextError = 0;
  double cost = linearize(views, result.point, JtJ, Jtr, error);
  for (int i = 0; i < kMaxIterations && std::isfinite(cost) && cost > 0; ++i) {
    const Eigen::Vector3d next = result.point - JtJ.ldlt().solve(Jtr);
    const double nextCost = linearize(views, next, nextJtJ, nextJtr, nextError);
    if (!(nextCost < cost)) break;
    const bool converged = cost - nextCost <= kConverged * cost;
    result.point = next;
    cost = nextCost;
    error = nextError;
    JtJ = nextJtJ;
    Jtr = nextJtr;
    if (converged) break;
  }
  result.isInFront = result.point.allFinite() && std::isfinite(cost);
  result.largestError = std::sqrt(error);
  return result;
}

bool haveParallax(const std::vector<View>& views, double minAngle) {
  std::vector<Eigen::Vector3d> directions;
  for (const View& view : views) {
    const Eigen::Vector3d a = view.rotation * view.direction();
    for (const Eigen::Vector3d& b : directions)
      if (std::atan2(a.cross(b).norm(), a.dot(b)) >= minAngle) return true;
    directions.push_back(a);
  }
  return false;
}

}  // namespace sfm
}  // namespace hybridgv
