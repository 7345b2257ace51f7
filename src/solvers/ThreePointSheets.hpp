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

#include "solvers/ThreePointFrame.hpp"

namespace hybridgv {
namespace solvers {

using math::Planar;

// Everything at one angle.
struct Sheets {
  double c, s;
  ImagePoint r0, r1, f0, f1;
  double w0, w1, w2;  // W = w2 eta^2 + w1 eta + w0

  Sheets(const ThreePointFrame& frame, double cosine, double sine) : c(cosine), s(sine) {
    const double cc = c * c, cs = c * s, ss = s * s;
    r0 = cc * frame.A11 + cs * frame.A21 + ss * frame.p3;
    f0 = cc * frame.A21 - cs * (frame.A11 - frame.p3);
    r1 = c * frame.D1 + s * frame.D2;
    f1 = c * frame.D2 - s * frame.D1;
    w0 = re(r0, f0);
    w1 = re(r0, f1) + re(r1, f0);
    w2 = re(r1, f1);
    const double least = 1e-30 * std::abs(w1);
    if (std::abs(w2) < least) w2 = least;
  }

  double discriminant() const { return w1 * w1 - 4 * w2 * w0; }

  // Both real roots eta, without cancellation.
  math::Pair realRoots(double discriminant) const {
    const double b = -(w1 + std::copysign(std::sqrt(discriminant), w1)) / 2;
    if (b == 0) return math::Pair{0, 0};
    return math::Pair{b / w2, w0 / b};
  }
};

// One eta (or two, T = Pair; or a complex one) over an angle.
template <class T>
struct Sheet {
  T eta, delta;  // delta = eta - s h: depth of X3, divided by rho
  Planar<T> zr, zf;
  T S, R, J;

  Sheet(const ThreePointFrame& frame, const Sheets& at, const T& root)
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
inline math::Complex Sheet<math::Complex>::n3() const {
  return squaredNorm(S) > squaredNorm(J) ? J / S : R / J;
}

// The product n3 delta K of an equation with the image point p, p' = p3 - p, K = im(p', zr) - im(p3, p). On W(eta) = 0 it is a
// polynomial, without the poles of n3:
//     -(re(D1, zr) (c k11 + s k21 + k1 eta) + k2 re(zr, c A21 + s (p3 - A11) + eta D2)) / im(D2, D1),
// k11 = im(p', A11 - p3), k21 = im(p', A21), k1 = im(p', D1), k2 = im(p', D2). Inaccurate where the image points are nearly
// collinear, im(D2, D1) = 0.
struct NormalProduct {
  const ThreePointFrame& frame;
  double k11, k21, k1, k2;
  bool valid;

  NormalProduct(const ThreePointFrame& f, const ImagePoint& difference) : frame(f) {
    const double area = im(frame.D2, frame.D1);
    valid = area * area > 1e-6 * re(frame.D1, frame.D1) * re(frame.D2, frame.D2);
    const ImagePoint scaled = (-1 / area) * difference;
    k11 = im(scaled, frame.A11 - frame.p3), k21 = im(scaled, frame.A21);
    k1 = im(scaled, frame.D1), k2 = im(scaled, frame.D2);
  }

  template <class T>
  T evaluate(const Sheets& at, const Sheet<T>& sheet) const {
    const Planar<T> y = (at.c * frame.A21 + at.s * (frame.p3 - frame.A11)) + sheet.eta * frame.D2;
    return re(frame.D1, sheet.zr) * ((at.c * k11 + at.s * k21) + k1 * sheet.eta) + k2 * re(sheet.zr, y);
  }
};

}  // namespace solvers
}  // namespace hybridgv
