// P3.5Pf: three 2D-3D points and the image x coordinate of a fourth.
#include <algorithm>
#include <cmath>

#include "solvers/MinimalProblems.hpp"
#include "solvers/three_points/ThreePointSolver.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {
namespace {

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

  template <class T>
  T product(const Sheets<T>& at, const Sheet<T>& first, const Sheet<T>& second) const {
    const T F = im(at.f1, at.f0), one = T{} + 1;
    const T n3First = first.n3(), n3Second = second.n3(), difference = math::absolute(n3First) - math::absolute(n3Second);
    // The factor F^2 goes to the root with the larger |n3|.
    const T factor1 = signProduct(at, first, difference > T{} ? F : one, difference > T{} ? re(at.f1, first.zr) : n3First);
    const T factor2 = signProduct(at, second, difference > T{} ? one : F, difference > T{} ? n3Second : re(at.f1, second.zr));
    return (at.w2 * factor1) * (at.w2 * factor2);
  }
  double norm(const Sheets<double>& at, const Sheet<Complex>& sheet) const {
    const double F = im(at.f1, at.f0);
    return squaredNorm((at.w2 / F) * signProduct(at, sheet, F, re(at.f1, sheet.zr)));
  }

  Residual residual(const Sheets<double>& at, const Sheet<double>& sheet, double n3, double rho) const {
    const Polar<double> y = at.polar(y_);
    return sumOfTerms({rho * sheet.zr.x * y.r, rho * sheet.zf.x * y.p, -rho * p_.x * y.r, rho * difference_.x * sheet.delta,
                       y_[2] * n3 * sheet.zr.x, -y_[2] * n3 * p_.x, -y_[2] * sheet.zf.y});
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
  // F^2 times the product over both signs of rho, nu = F n3.
  template <class A, class T, class F>
  T signProduct(const Sheets<A>& at, const Sheet<T>& sheet, const F& f, const T& nu) const {
    const Polar<A> y = at.polar(y_);
    const T odd = y.r * (sheet.zr.x - p_.x) + y.p * sheet.zf.x + difference_.x * sheet.delta;
    const T even = y_[2] * (nu * (sheet.zr.x - p_.x) - f * sheet.zf.y);
    return (f * f - nu * nu) * (odd * odd) - even * even;
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

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
