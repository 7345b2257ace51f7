// H13f: three 2D-3D points and one ray.
#include <algorithm>
#include <cmath>

#include "solvers/MinimalProblems.hpp"
#include "solvers/three_points/ThreePointSolver.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {
namespace {

// The ray X3 + c + beta q meets the line of sight through the image point p: im(conj(E(c)) E(q)) = 0.
//
// With m = q x c, q_r = q . e_rho and so on, p' = p3 - p, delta = depth of X3 / rho and K = im(p', zr) - im(p3, p) this is
//
//     even + rho odd = 0,
//     odd  = m3 (im(p, zf) - J) + delta (q_r K + q_p im(p', zf)),
//     even = -m_r (S - R + re(p, zr)) - m_p re(p, zf) + q3 delta (re(p', zf) + n3 K),
//
// and the product over the signs of rho and the roots eta, w2^4 prod ((1 - n3^2) odd^2 - even^2), is a form of degree 12.
class RayEquation {
 public:
  static constexpr int kDegree = 12;

  RayEquation(const ThreePointFrame& frame, const RayMatch& ray)
      : frame_(frame),
        p_(frame.image(ray.u, ray.v)),
        difference_(frame.p3 - p_),
        normalProduct_(frame, difference_),
        q_(frame.direction(ray.direction)) {
    origin_ = frame.fromX3(ray.centre);
    c_ = origin_ - q_.dot(origin_) * q_;
    m_ = q_.cross(c_);
    area_ = im(frame.p3, p_);
  }

  template <class T>
  T product(const Sheets<T>& at, const Sheet<T>& first, const Sheet<T>& second) const {
    const T w = at.w2 * at.w2;
    return (w * signProduct(at, first)) * (w * signProduct(at, second));
  }
  double norm(const Sheets<double>& at, const Sheet<Complex>& sheet) const {
    return squaredNorm((at.w2 * at.w2) * signProduct(at, sheet));
  }

  Residual residual(const Sheets<double>& at, const Sheet<double>& sheet, double n3, double rho) const {
    const Polar<double> q = at.polar(q_), m = at.polar(m_);
    const double K = im(difference_, sheet.zr) - area_;
    return sumOfTerms({rho * m_[2] * im(p_, sheet.zf), -rho * m_[2] * sheet.J, rho * sheet.delta * q.r * K,
                       rho * sheet.delta * q.p * im(difference_, sheet.zf), m.r * sheet.R, -m.r * sheet.S,
                       -m.r * re(p_, sheet.zr), -m.p * re(p_, sheet.zf), q_[2] * sheet.delta * re(difference_, sheet.zf),
                       q_[2] * sheet.delta * n3 * K});
  }

  WithGradient<double> constraint(const SurfacePoint& point) const {
    return area(point.point(frame_, p_, c_), point.direction(p_, q_));
  }

  double frontoParallelStart(double side) const {
    const ImagePoint a = q_[0] * frame_.D1 + q_[1] * frame_.D2, b = c_[0] * frame_.D1 + c_[1] * frame_.D2 + difference_;
    return side * (q_[2] * im(b, p_) + c_[2] * im(p_, a)) / im(b, a);
  }
  FrontoParallelPoint::Row frontoParallelConstraint(const FrontoParallelPoint& point) const {
    const FrontoParallelPoint::Row a = point.point(frame_, p_, c_), b = point.direction(frame_, p_, q_);
    return {{im(a.value, b.value), 0},
            {im(a.u, b.value) + im(a.value, b.u), 0},
            {im(a.v, b.value) + im(a.value, b.v), 0},
            {im(a.d, b.value) + im(a.value, b.d), 0}};
  }

  double rank(const FramePose& pose) const {
    const Eigen::Vector3d a = pose.rotate(q_), t = pose.transform(origin_), b(p_.x, p_.y, pose.f);
    const Eigen::Vector3d n = b.cross(a);
    const double beta = -b.cross(t).dot(n) / n.squaredNorm();
    if (!(beta > 0)) return -1;
    const double error = imageError(pose, t + beta * a, p_);
    return error >= 0 && error < kMaxImageError ? 0 : -1;
  }

 private:
  // The product over both signs of rho: odd^2 - (n3 odd)^2 - even^2.
  template <class A, class T>
  T signProduct(const Sheets<A>& at, const Sheet<T>& sheet) const {
    const Polar<A> q = at.polar(q_), m = at.polar(m_);
    const T K = im(difference_, sheet.zr) - area_;
    const T odd = m_[2] * (im(p_, sheet.zf) - sheet.J) + sheet.delta * (q.r * K + q.p * im(difference_, sheet.zf));
    T n3DeltaK, n3Odd;
    if (normalProduct_.isAccurate) {
      n3DeltaK = normalProduct_.evaluate(at, sheet);
      n3Odd = m_[2] * (re(p_, sheet.zr) - sheet.R) + q.p * (sheet.delta * re(difference_, sheet.zr)) + q.r * n3DeltaK;
    } else {
      const T n3 = sheet.n3();
      n3DeltaK = n3 * sheet.delta * K;
      n3Odd = n3 * odd;
    }
    const T even = m.r * (sheet.R - sheet.S - re(p_, sheet.zr)) - m.p * re(p_, sheet.zf) +
                   q_[2] * (sheet.delta * re(difference_, sheet.zf) + n3DeltaK);
    return odd * odd - n3Odd * n3Odd - even * even;
  }

  const ThreePointFrame& frame_;
  ImagePoint p_, difference_;
  NormalProduct normalProduct_;
  Eigen::Vector3d q_;
  Eigen::Vector3d origin_, c_;  // from X3: the ray's centre, and its point nearest to X3
  Eigen::Vector3d m_;
  double area_;
};

// A ray through a point that is seen in the same place adds no equation.
bool repeats(const RayMatch& ray, const PointMatch& match, double imageScale) {
  constexpr double kSame = 1e-12;  // relative
  if (std::max(std::abs(ray.u - match.u), std::abs(ray.v - match.v)) > kSame * imageScale) return false;
  const Eigen::Vector3d toPoint = match.point - ray.centre;
  return toPoint.cross(ray.direction).norm() <= kSame * (ray.centre.norm() + match.point.norm());
}

}  // namespace

int h13f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  const double rayImage = std::max(std::abs(rays[0].u), std::abs(rays[0].v));
  for (int i = 0; i < 3; ++i)
    if (repeats(rays[0], points[i], rayImage)) return 0;
  ThreePointFrame frame;
  if (!frame.set(points[0], points[1], points[2], rayImage)) return 0;
  const RayEquation equation(frame, rays[0]);
  return ThreePointSolver<RayEquation>(frame, equation, solutions).solve();
}

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
