// P4Pf: four 2D-3D points, eight equations for seven unknowns.
#include <algorithm>
#include <cmath>

#include "solvers/MinimalProblems.hpp"
#include "solvers/three_points/ThreePointSolver.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {
namespace {

// The image of the line through X4 = X3 + y along the normal e3 of the plane of the other points passes through p:
// im(conj(E(y)) E(e3)) = 0. The position of X4 along that line, the eighth equation, only ranks the solutions.
//
// With y_r = y . e_rho and so on, p' = p3 - p, delta = depth of X3 / rho, K = im(p', zr) - im(p3, p) this is free of rho,
//
//     g = -y_p (S - R + re(p, zr)) + y_r re(p, zf) - delta (re(p', zf) + n3 K) = 0,
//
// and w2^2 times the product over the roots eta is a form of degree 6. It does not contain y3: the four points may be coplanar.
class NormalEquation {
 public:
  static constexpr int kDegree = 6;

  NormalEquation(const ThreePointFrame& frame, const PointMatch& match)
      : frame_(frame),
        p_(frame.image(match.u, match.v)),
        difference_(frame.p3 - p_),
        normalProduct_(frame, difference_),
        y_(frame.fromX3(match.point)) {
    area_ = im(frame.p3, p_);
  }

  template <class T>
  T product(const Sheets<T>& at, const Sheet<T>& first, const Sheet<T>& second) const {
    return (at.w2 * value(at, first)) * (at.w2 * value(at, second));
  }
  double norm(const Sheets<double>& at, const Sheet<Complex>& sheet) const { return squaredNorm(at.w2 * value(at, sheet)); }

  Residual residual(const Sheets<double>& at, const Sheet<double>& sheet, double n3, double) const {
    const Polar<double> y = at.polar(y_);
    const double K = im(difference_, sheet.zr) - area_;
    return sumOfTerms({y.p * sheet.R, -y.p * sheet.S, -y.p * re(p_, sheet.zr), y.r * re(p_, sheet.zf),
                       -sheet.delta * re(difference_, sheet.zf), -sheet.delta * n3 * K});
  }

  WithGradient<double> constraint(const SurfacePoint& point) const {
    return area(point.point(frame_, p_, y_), point.direction(p_, Eigen::Vector3d(0, 0, 1)));
  }

  // For rho = 0 the equation holds for every f, so that this case uses both parts of E(y) = 0.
  double frontoParallelStart(double side) const {
    const ImagePoint b = y_[0] * frame_.D1 + y_[1] * frame_.D2 + difference_;
    return side * y_[2] * re(b, p_) / re(b, b);
  }
  FrontoParallelPoint::Row frontoParallelConstraint(const FrontoParallelPoint& point) const {
    return point.point(frame_, p_, y_);
  }

  // The image error of X4.
  double rank(const FramePose& pose) const {
    const Eigen::Vector3d point = pose.transform(y_);
    const Eigen::Vector3d normal(pose.r1[2], pose.r2[2], pose.r3[2]);
    // E(y) and E(e3)
    const ImagePoint a{pose.f * point[0] - p_.x * point[2], pose.f * point[1] - p_.y * point[2]};
    const ImagePoint b{pose.f * normal[0] - p_.x * normal[2], pose.f * normal[1] - p_.y * normal[2]};
    if (!(std::abs(im(a, b)) <= kMaxImageError * point[2] * std::sqrt(re(b, b)))) return -1;
    return imageError(pose, point, p_);
  }

 private:
  template <class A, class T>
  T value(const Sheets<A>& at, const Sheet<T>& sheet) const {
    const Polar<A> y = at.polar(y_);
    const T n3DeltaK = normalProduct_.isAccurate ? normalProduct_.evaluate(at, sheet)
                                                 : sheet.n3() * sheet.delta * (im(difference_, sheet.zr) - area_);
    return y.p * (sheet.R - sheet.S - re(p_, sheet.zr)) + y.r * re(p_, sheet.zf) - sheet.delta * re(difference_, sheet.zf) -
           n3DeltaK;
  }

  const ThreePointFrame& frame_;
  ImagePoint p_, difference_;
  NormalProduct normalProduct_;
  Eigen::Vector3d y_;  // from X3
  double area_;
};

}  // namespace

int p4pf(const RayMatch*, const PointMatch* points, FocalPose* solutions) {
  ThreePointFrame frame;
  if (!frame.set(points[0], points[1], points[2], std::max(std::abs(points[3].u), std::abs(points[3].v)))) return 0;
  const NormalEquation equation(frame, points[3]);
  return ThreePointSolver<NormalEquation>(frame, equation, solutions).solve();
}

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
