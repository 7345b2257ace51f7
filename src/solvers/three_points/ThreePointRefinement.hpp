// Newton's method on the surface of ThreePointSheets.hpp, in (phi, theta, eta) with n3 = cos theta, rho = sin theta.
#pragma once

#include "solvers/three_points/ThreePointPose.hpp"
#include "solvers/three_points/ThreePointSheets.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {

// A function on the surface with its derivatives.
template <class T>
struct WithGradient {
  T value, phi, theta, eta;
};

struct SurfacePoint {
  double c, s, n3, rho, eta;
  // Derived from them.
  double delta;
  ImagePoint zr, zf, r1, f1, zrPhi, zfPhi;  // zrPhi, zfPhi: derivatives by phi

  void update(const ThreePointFrame& frame) {
    delta = eta - s * frame.h;
    r1 = c * frame.D1 + s * frame.D2;
    f1 = c * frame.D2 - s * frame.D1;
    const ImagePoint z1 = c * frame.A11 + eta * frame.D1, z2 = c * frame.A21 + s * frame.p3 + eta * frame.D2;  // z / rho
    const ImagePoint z1Phi = (-s) * frame.A11, z2Phi = c * frame.p3 - s * frame.A21;
    zr = c * z1 + s * z2;
    zf = c * z2 - s * z1;
    zrPhi = zf + (c * z1Phi + s * z2Phi);
    zfPhi = (c * z2Phi - s * z1Phi) - zr;
  }

  // phi += dPhi, theta += dTheta (exact to third order), eta += dEta
  void move(double dPhi, double dTheta, double dEta) {
    const double scalePhi = 1 / std::sqrt(1 + dPhi * dPhi), scaleTheta = 1 / std::sqrt(1 + dTheta * dTheta);
    const double oldC = c, oldN3 = n3;
    c = (c - dPhi * s) * scalePhi;
    s = (s + dPhi * oldC) * scalePhi;
    n3 = (n3 - dTheta * rho) * scaleTheta;
    rho = (rho + dTheta * oldN3) * scaleTheta;
    eta += dEta;
  }

  // zr = -i n3 zf
  WithGradient<ImagePoint> threePoints() const {
    return {zr + n3 * timesI(zf), zrPhi + n3 * timesI(zfPhi), (-rho) * timesI(zf), r1 + n3 * timesI(f1)};
  }

  // E(q) = z.q - p n.q for a direction q
  WithGradient<ImagePoint> direction(const ImagePoint& p, const Eigen::Vector3d& q) const {
    const double qr = c * q[0] + s * q[1], qp = c * q[1] - s * q[0];
    const double along = rho * q[2] - n3 * qr, depth = rho * qr + n3 * q[2];
    const ImagePoint factor{qp, along};
    return {rho * product(zf, factor) - depth * p,
            rho * (product(zfPhi, factor) + product(zf, ImagePoint{-qr, -n3 * qp})) - (rho * qp) * p,
            product(zf, ImagePoint{n3 * qp, n3 * along + rho * depth}) + along * p, rho * product(f1, factor)};
  }

  // E(y) = z.y - p n.y + (p3 - p) d3 for the point X3 + y
  WithGradient<ImagePoint> point(const ThreePointFrame& frame, const ImagePoint& p, const Eigen::Vector3d& y) const {
    WithGradient<ImagePoint> result = direction(p, y);
    const ImagePoint difference = frame.p3 - p;
    result.value = result.value + (rho * delta) * difference;
    result.phi = result.phi - (rho * c * frame.h) * difference;
    result.theta = result.theta + (n3 * delta) * difference;
    result.eta = result.eta + rho * difference;
    return result;
  }

  // The pose: with z = rho zf (-i n3, 1, i rho) in (e_r, e_phi, e3) and ph = rho zf / |rho zf|, r1 + i r2 = z / f.
  FramePose pose(const ThreePointFrame& frame) const {
    const ImagePoint z = rho * zf;
    FramePose result;
    result.f = std::sqrt(re(z, z));
    const ImagePoint ph = (1 / result.f) * z;
    const auto inFrame = [&](double radial, double tangential, double normal) {
      return Eigen::Vector3d(c * radial - s * tangential, s * radial + c * tangential, normal);
    };
    result.r1 = inFrame(n3 * ph.y, ph.x, -rho * ph.y);
    result.r2 = inFrame(-n3 * ph.x, ph.y, rho * ph.x);
    result.r3 = inFrame(rho, 0, n3);
    const double depth = rho * delta;
    result.x3 = {frame.p3.x * depth / result.f, frame.p3.y * depth / result.f, depth};
    return result;
  }
};

// im(conj(a) b): vanishes where a and b have the same direction
inline WithGradient<double> area(const WithGradient<ImagePoint>& a, const WithGradient<ImagePoint>& b) {
  return {im(a.value, b.value), im(a.phi, b.value) + im(a.value, b.phi), im(a.theta, b.value) + im(a.value, b.theta),
          im(a.eta, b.value) + im(a.value, b.eta)};
}

// Solves zr = -i n3 zf together with `constraint`(point) = 0, a WithGradient<double>. False if the iteration does not converge.
template <class Constraint>
bool refine(SurfacePoint& point, const ThreePointFrame& frame, const Constraint& constraint) {
  for (int iteration = 0; iteration < 12; ++iteration) {
    point.update(frame);
    const WithGradient<ImagePoint> e = point.threePoints();
    const WithGradient<double> g = constraint(point);
    // Cramer's rule; rows (e.x), (e.y), (g)
    const double phiTheta = im(e.phi, e.theta), thetaEta = im(e.theta, e.eta), etaPhi = im(e.eta, e.phi);
    const double scale = -1 / (g.eta * phiTheta + g.phi * thetaEta + g.theta * etaPhi);
    const double valuePhi = im(e.value, e.phi), valueTheta = im(e.value, e.theta), valueEta = im(e.value, e.eta);
    const double dPhi = scale * (g.value * thetaEta + g.eta * valueTheta - g.theta * valueEta);
    const double dTheta = scale * (g.value * etaPhi + g.phi * valueEta - g.eta * valuePhi);
    const double dEta = scale * (g.value * phiTheta + g.theta * valuePhi - g.phi * valueTheta);
    if (!(std::abs(dPhi) < 1) || !(std::abs(dTheta) < 1) || !std::isfinite(dEta)) return false;
    point.move(dPhi, dTheta, dEta);
    const double step = std::abs(dPhi) + std::abs(dTheta) + std::abs(dEta) / (1 + std::abs(point.eta));
    if (step < 1e-7) {
      point.update(frame);
      return true;
    }
  }
  return false;
}

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
