// The poses that see three given points (with any focal length) as a surface over the circle of angles phi.
//
// With n = (rho c, rho s, n3) in the frame of ThreePointFrame, (c, s) = (cos phi, sin phi), rho^2 + n3^2 = 1, and d = rho eta:
//
//     zr = (z . e_rho) / rho = r0 + eta r1,   e_rho = c e1 + s e2,
//     zf = (z . e_phi) / rho = f0 + eta f1,   e_phi = c e2 - s e1,
//
// and n x z = -i z becomes zr = -i n3 zf. So eta is a root of the real quadratic W(eta) = re(zr, zf), and with S = |zf|^2,
// R = |zr|^2, J = im(zr, zf) both n3 = J / S and n3 = R / J hold. Four sheets: two roots eta, two signs of rho. The depths of the
// points are rho (eta + c a1), rho (eta + c b1), rho (eta - s h).
#pragma once

#include "solvers/three_points/ThreePointFrame.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {

using Complex = math::Complex<double>;
using math::Pair;
using math::Planar;

// Components of a vector of the frame along e_rho and e_phi.
template <class T>
struct Polar {
  T r, p;
  Polar(const Eigen::Vector3d& v, const T& c, const T& s) : r(c * v[0] + s * v[1]), p(c * v[1] - s * v[0]) {}
};

// Everything at one angle, or at two (T = Pair).
template <class T>
struct Sheets {
  T c, s;
  Planar<T> r0, r1, f0, f1;
  T w0, w1, w2;  // W = w2 eta^2 + w1 eta + w0

  Sheets(const ThreePointFrame& frame, const T& cosine, const T& sine) : c(cosine), s(sine) {
    const T cc = c * c, cs = c * s, ss = s * s;
    r0 = cc * frame.A11 + cs * frame.A21 + ss * frame.p3;
    f0 = cc * frame.A21 - cs * (frame.A11 - frame.p3);
    r1 = c * frame.D1 + s * frame.D2;
    f1 = c * frame.D2 - s * frame.D1;
    w0 = re(r0, f0);
    w1 = re(r0, f1) + re(r1, f0);
    w2 = re(r1, f1);
    const T least = 1e-30 * math::absolute(w1);
    w2 = math::absolute(w2) < least ? least : w2;
  }

  Polar<T> polar(const Eigen::Vector3d& v) const { return {v, c, s}; }
  T discriminant() const { return w1 * w1 - 4 * w2 * w0; }

  // Both roots eta, without cancellation. A negative discriminant counts as zero.
  void realRoots(const T& discriminant, T& first, T& second) const {
    const T zero{}, tiny = zero + 1e-300, root = math::squareRoot(math::larger(discriminant, zero));
    const T b = -0.5 * (w1 > zero ? w1 + root : w1 - root);
    first = b / w2;
    second = w0 / (b == zero ? tiny : b);
  }
  // One of the conjugate roots for a negative discriminant.
  Complex complexRoot(double discriminant) const {
    const double scale = 0.5 / w2;
    return {-w1 * scale, std::sqrt(-discriminant) * scale};
  }
};

// One root eta over an angle (T = Pair: over two angles; T = Complex: a complex root).
template <class T>
struct Sheet {
  T eta, delta;  // delta = eta - s h: depth of X3, divided by rho
  Planar<T> zr, zf;
  T S, R, J;

  template <class A>
  Sheet(const ThreePointFrame& frame, const Sheets<A>& at, const T& root)
      : eta(root),
        delta(root - at.s * frame.h),
        zr(at.r0 + root * at.r1),
        zf(at.f0 + root * at.f1),
        S(re(zf, zf)),
        R(re(zr, zr)),
        J(im(zr, zf)) {}

  // J/S and R/J, weighted by the squares of their denominators.
  T n3() const { return J * (S + R) / (S * S + J * J); }
};

template <>
inline Complex Sheet<Complex>::n3() const {
  return squaredNorm(S) > squaredNorm(J) ? J / S : R / J;
}

// The product n3 delta K of an equation with the image point p, p' = p3 - p, K = im(p', zr) - im(p3, p). Where W(eta) = 0 it is
// the polynomial
//     -(re(D1, zr) (c k11 + s k21 + k1 eta) + k2 re(zr, c A21 + s (p3 - A11) + eta D2)) / im(D2, D1),
//     k11 = im(p', A11 - p3), k21 = im(p', A21), k1 = im(p', D1), k2 = im(p', D2),
// without the poles of n3; but inaccurate where the image points are nearly collinear, im(D2, D1) = 0.
struct NormalProduct {
  const ThreePointFrame& frame;
  double k11, k21, k1, k2;
  bool isAccurate;

  NormalProduct(const ThreePointFrame& f, const ImagePoint& difference) : frame(f) {
    const double area = im(frame.D2, frame.D1);
    isAccurate = area * area > 1e-6 * re(frame.D1, frame.D1) * re(frame.D2, frame.D2);
    const ImagePoint scaled = (-1 / area) * difference;
    k11 = im(scaled, frame.A11 - frame.p3);
    k21 = im(scaled, frame.A21);
    k1 = im(scaled, frame.D1);
    k2 = im(scaled, frame.D2);
  }

  template <class A, class T>
  T evaluate(const Sheets<A>& at, const Sheet<T>& sheet) const {
    const Planar<T> y = (at.c * frame.A21 + at.s * (frame.p3 - frame.A11)) + sheet.eta * frame.D2;
    return re(frame.D1, sheet.zr) * ((at.c * k11 + at.s * k21) + k1 * sheet.eta) + k2 * re(sheet.zr, y);
  }
};

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
