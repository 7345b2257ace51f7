// H13f: three 2D-3D points and one ray.
#include <algorithm>
#include <cmath>

#include "solvers/ThreePointSolver.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace solvers {
namespace {

using math::Complex;
using math::Pair;

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
        product_(frame, difference_),
        q_(frame.direction(ray.direction)) {
    origin_ = frame.fromX3(ray.centre);
    c_ = origin_ - q_.dot(origin_) * q_;
    m_ = q_.cross(c_);
    area_ = im(frame.p3, p_);
  }

  double product(const Sheets& at, const Sheet<Pair>& sheet) const {
    const Pair factor = signProduct(at, sheet);
    const double w = at.w2 * at.w2;
    return (w * factor[0]) * (w * factor[1]);
  }
  double norm(const Sheets& at, const Sheet<Complex>& sheet) const {
    return squaredNorm((at.w2 * at.w2) * signProduct(at, sheet));
  }

  Residual residual(const Sheets& at, const Sheet<double>& sheet, double n3, double rho) const {
    const Along along(*this, at);
    const double K = im(difference_, sheet.zr) - area_;
    const double terms[10] = {rho * m_[2] * im(p_, sheet.zf),
                              -rho * m_[2] * sheet.J,
                              rho * sheet.delta * along.qr * K,
                              rho * sheet.delta * along.qp * im(difference_, sheet.zf),
                              along.mr * sheet.R,
                              -along.mr * sheet.S,
                              -along.mr * re(p_, sheet.zr),
                              -along.mp * re(p_, sheet.zf),
                              q_[2] * sheet.delta * re(difference_, sheet.zf),
                              q_[2] * sheet.delta * n3 * K};
    Residual result{0, 0};
    for (double term : terms) result.value += term, result.magnitude += std::abs(term);
    return result;
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
  // Components of q and m along e_rho and e_phi.
  struct Along {
    double qr, qp, mr, mp;
    Along(const RayEquation& equation, const Sheets& at)
        : qr(at.c * equation.q_[0] + at.s * equation.q_[1]),
          qp(at.c * equation.q_[1] - at.s * equation.q_[0]),
          mr(at.c * equation.m_[0] + at.s * equation.m_[1]),
          mp(at.c * equation.m_[1] - at.s * equation.m_[0]) {}
  };

  // The product over both signs of rho.
  template <class T>
  T signProduct(const Sheets& at, const Sheet<T>& sheet) const {
    const Along along(*this, at);
    const T K = im(difference_, sheet.zr) - area_;
    const T odd = m_[2] * (im(p_, sheet.zf) - sheet.J) + sheet.delta * (along.qr * K + along.qp * im(difference_, sheet.zf));
    const T n3DeltaK = product_.valid ? product_.evaluate(at, sheet) : sheet.n3() * sheet.delta * K;
    const T oddN3 = product_.valid ? m_[2] * (re(p_, sheet.zr) - sheet.R) + sheet.delta * (along.qp * re(difference_, sheet.zr)) +
                                         along.qr * n3DeltaK
                                   : sheet.n3() * odd;
    const T even = along.mr * (sheet.R - sheet.S - re(p_, sheet.zr)) - along.mp * re(p_, sheet.zf) +
                   q_[2] * (sheet.delta * re(difference_, sheet.zf) + n3DeltaK);
    return odd * odd - oddN3 * oddN3 - even * even;
  }

  const ThreePointFrame& frame_;
  ImagePoint p_, difference_;
  NormalProduct product_;
  Eigen::Vector3d q_;
  Eigen::Vector3d origin_, c_;  // from X3: the ray's centre, and its point nearest to X3
  Eigen::Vector3d m_;
  double area_;
};

}  // namespace

int h13f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  const double rayImage = std::max(std::abs(rays[0].u), std::abs(rays[0].v));
  ThreePointFrame frame;
  if (!frame.set(points[0], points[1], points[2], rayImage)) return 0;
  const RayEquation equation(frame, rays[0]);
  return ThreePointSolver<RayEquation>(frame, equation, solutions).solve();
}

}  // namespace solvers
}  // namespace hybridgv
