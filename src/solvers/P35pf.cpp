// P3.5Pf: three 2D-3D points and the image x coordinate of a fourth.
#include <algorithm>
#include <cmath>

#include "solvers/ThreePointSolver.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace solvers {
namespace {

using math::Complex;
using math::Pair;

// The point X3 + y has the image coordinate p.x: Re E(y) = 0.
//
// With y_r = y . e_rho and so on, p' = p3 - p, delta = depth of X3 / rho this is even + rho odd = 0,
//
//     odd  = Re(zr) y_r + Re(zf) y_p - Re(p) y_r + Re(p') delta,
//     even = y3 (n3 (Re zr - Re p) - Im zf).
//
// On one of the two roots eta n3 is infinite where F = im(f1, f0) vanishes; nu = F n3 = re(f1, zr) is not. The product over the
// signs of rho and the roots eta, w2^2 F^2 prod ((1 - n3^2) odd^2 - even^2), is a form of degree 10.
class CoordinateEquation {
 public:
  static constexpr int kDegree = 10;

  CoordinateEquation(const ThreePointFrame& frame, const PointMatch& match)
      : frame_(frame), p_(frame.image(match.u, match.v)), difference_(frame.p3 - p_), y_(frame.fromX3(match.point)) {}

  double product(const Sheets& at, const Sheet<Pair>& sheet) const {
    const double F = im(at.f1, at.f0);
    const Pair n3 = sheet.n3(), nuF = re(at.f1, sheet.zr);
    // The factor F^2 goes to the root with the larger |n3|.
    const bool first = std::abs(n3[0]) > std::abs(n3[1]);
    const Pair weight = first ? Pair{F, 1} : Pair{1, F};
    const Pair nu = first ? Pair{nuF[0], n3[1]} : Pair{n3[0], nuF[1]};
    const Pair odd = oddPart(at, sheet);
    const Pair even = y_[2] * (nu * (sheet.zr.x - p_.x) - weight * sheet.zf.y);
    const Pair factor = (weight * weight - nu * nu) * (odd * odd) - even * even;
    return (at.w2 * factor[0]) * (at.w2 * factor[1]);
  }

  double norm(const Sheets& at, const Sheet<Complex>& sheet) const {
    const double F = im(at.f1, at.f0);
    const Complex nu = re(at.f1, sheet.zr);
    const Complex odd = oddPart(at, sheet);
    const Complex even = y_[2] * (nu * (sheet.zr.x - p_.x) - F * sheet.zf.y);
    return squaredNorm((at.w2 / F) * ((F * F - nu * nu) * (odd * odd) - even * even));
  }

  Residual residual(const Sheets& at, const Sheet<double>& sheet, double n3, double rho) const {
    const double yr = at.c * y_[0] + at.s * y_[1], yp = at.c * y_[1] - at.s * y_[0];
    const double terms[7] = {
        rho * sheet.zr.x * yr,   rho * sheet.zf.x * yp, -rho * p_.x * yr,   rho * difference_.x * sheet.delta,
        y_[2] * n3 * sheet.zr.x, -y_[2] * n3 * p_.x,    -y_[2] * sheet.zf.y};
    Residual result{0, 0};
    for (double term : terms) result.value += term, result.magnitude += std::abs(term);
    return result;
  }

  WithGradient<double> constraint(const SurfacePoint& point) const {
    const WithGradient<ImagePoint> e = point.point(frame_, p_, y_);
    return {e.value.x, e.phi.x, e.theta.x, e.eta.x};
  }

  double frontoParallelStart(double side) const {
    return side * p_.x * y_[2] / (y_[0] * frame_.D1.x + y_[1] * frame_.D2.x + difference_.x);
  }
  FrontoParallelPoint::Row frontoParallelConstraint(const FrontoParallelPoint& point) const {
    const FrontoParallelPoint::Row e = point.point(frame_, p_, y_);
    return {{e.value.x, 0}, {e.u.x, 0}, {e.v.x, 0}, {e.d.x, 0}};
  }

  double rank(const FramePose& pose) const {
    const Eigen::Vector3d point = pose.transform(y_);
    return point[2] > 0 && std::abs(pose.f * point[0] / point[2] - p_.x) < kMaxImageError ? 0 : -1;
  }

 private:
  template <class T>
  T oddPart(const Sheets& at, const Sheet<T>& sheet) const {
    const double yr = at.c * y_[0] + at.s * y_[1], yp = at.c * y_[1] - at.s * y_[0];
    return yr * (sheet.zr.x - p_.x) + yp * sheet.zf.x + difference_.x * sheet.delta;
  }

  const ThreePointFrame& frame_;
  ImagePoint p_, difference_;
  Eigen::Vector3d y_;  // from X3
};

}  // namespace

int p35pf(const RayMatch*, const PointMatch* points, FocalPose* solutions) {
  ThreePointFrame frame;
  if (!frame.set(points[0], points[1], points[2], std::max(std::abs(points[3].u), std::abs(points[3].v)))) return 0;
  const CoordinateEquation equation(frame, points[3]);
  return ThreePointSolver<CoordinateEquation>(frame, equation, solutions).solve();
}

}  // namespace solvers
}  // namespace hybridgv
