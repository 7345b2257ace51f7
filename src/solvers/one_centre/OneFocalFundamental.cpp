#include "solvers/one_centre/OneFocalFundamental.hpp"

#include <algorithm>
#include <cmath>

#include "math/Vec3.hpp"
#include "math/roots/BinaryFormRoots.hpp"
#include "solvers/one_centre/OneFocalDecomposition.hpp"
#include "solvers/one_centre/OneFocalPencil.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {
namespace {

using math::Pair;
using math::Vec3;

constexpr int kMaxRoots = math::BinaryFormRoots<9>::kMaxRoots;
constexpr int kMaxCandidates = 2 * kMaxRoots + 2;

// Zeros F = x B0 + c B1 + s B2 of det F and Q, to be; as arrays, so that two are treated at once.
struct Candidates {
  int count = 0;
  double x[kMaxCandidates], c[kMaxCandidates], s[kMaxCandidates];

  void add(double newX, double newC, double newS) {
    x[count] = newX;
    c[count] = newC;
    s[count] = newS;
    ++count;
  }
  // An odd last one is repeated to make a pair.
  void pad() {
    if (count > 0) {
      x[count] = x[count - 1];
      c[count] = c[count - 1];
      s[count] = s[count - 1];
    }
  }
};

// Roots of the form; with a principal point among the image points the form is divided by the square of its known factor.
int rootDirections(const OneFocalPencil& pencil, const SixCorrespondences& data, math::Direction* roots) {
  using Full = math::BinaryFormRoots<9>;
  using Deflated = math::BinaryFormRoots<7>;
  constexpr double kAtPrincipalPoint = 1e-12;
  for (int k = 0; k < kSix; ++k) {
    if (std::abs(data.u[k]) > kAtPrincipalPoint || std::abs(data.v[k]) > kAtPrincipalPoint) continue;
    const math::Direction known = pencil.withoutThirdRow();
    return Deflated::findSampled(
        [&](const double* c, const double* s, double* p) {
          for (int j = 0; j < Deflated::kPadded; j += 2) {
            const Pair cs = math::load<Pair>(c + j), sn = math::load<Pair>(s + j), factor = cs * known.s - sn * known.c;
            math::store(p + j, pencil.form(cs, sn) / (factor * factor));
          }
        },
        roots);
  }
  return Full::findSampled(
      [&](const double* c, const double* s, double* p) {
        for (int j = 0; j < Full::kPadded; j += 2)
          math::store(p + j, pencil.form(math::load<Pair>(c + j), math::load<Pair>(s + j)));
      },
      roots);
}

// The two x of a root of the form, from the quadratics x^2 r2 + x r1 + r0 = 0.
struct RootCoordinates {
  Pair x, other;
  bool otherCounts[2];

  explicit RootCoordinates(const OneFocalPencil::Quadratics<Pair>& m) {
    // Their common zero: (x^2, x, 1) ~ (r1 x r0, r0 x r2, r2 x r1) = (a, b, d). As x^2 + 1 > 0, n = a + d is the direction of all
    // three; x = x (x^2 + 1) / (x^2 + 1) loses nothing where x is large.
    const Vec3<Pair> a = cross(m.r1, m.r0), b = cross(m.r0, m.r2), d = cross(m.r2, m.r1), n = a + d;
    const Pair nb = dot(n, b), nd = dot(n, d), nn = dot(n, n);
    x = nb * nn / (nb * nb + nd * nd);
    // Where the three quadratics are nearly multiples of one, its other zero is near a solution, too.
    constexpr double kNearlyOne = 1e-3;
    const Pair r22 = dot(m.r2, m.r2), r00 = dot(m.r0, m.r0), size = r22 + dot(m.r1, m.r1) + r00;
    for (int lane = 0; lane < 2; ++lane) otherCounts[lane] = nn[lane] < kNearlyOne * kNearlyOne * (size[lane] * size[lane]);
    const Vec3<Pair> u = m.r2 + signs(dot(m.r2, m.r0)) * m.r0;
    other = -dot(m.r1, u) / dot(m.r2, u) - x;
  }
};

// Those with f^2 clearly negative are left out.
Candidates findCandidates(const OneFocalPencil& pencil, const math::Direction* roots, int count) {
  constexpr double kClearly = 1.001;
  Candidates candidates;
  for (int i = 0; i < count; i += 2) {
    const int j = std::min(i + 1, count - 1);
    const Pair c{roots[i].c, roots[j].c}, s{roots[i].s, roots[j].s};
    const RootCoordinates root(pencil.quadratics(c, s));
    const FocalDenominator<Pair> denominator(pencil.at(root.x, c, s));
    for (int lane = 0; lane < 2 && i + lane < count; ++lane) {
      if (denominator.minuend[lane] * kClearly > denominator.subtrahend[lane]) candidates.add(root.x[lane], c[lane], s[lane]);
      if (root.otherCounts[lane]) candidates.add(root.other[lane], c[lane], s[lane]);
    }
  }
  return candidates;
}

// Newton's iteration in (x, psi) on det F = 0 and n.Q = 0, n one direction of all cross products of rows: on det F = 0 these are
// parallel to the null vector of F, as is Q, which then vanishes with n.Q. Returns whether each lane converged.
struct Converged {
  bool lane[2];
};
Converged refine(const OneFocalPencil& pencil, Pair& x, Pair& c, Pair& s) {
  bool running[2] = {true, true}, converged[2] = {false, false};
  double last[2] = {1, 1};
  const Rows<double>& b = pencil.derivativeX();
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Rows<Pair> f = pencil.at(x, c, s), g = pencil.derivativePsi(c, s);
    const Vec3<Pair> v = cross(f.f1, f.f3), w = cross(f.f2, f.f3);
    const Vec3<Pair> n = v + signs(dot(v, w)) * w;
    const Rows<Pair> cofactor{w, cross(f.f3, f.f1), cross(f.f1, f.f2)};
    const Pair det = dot(f.f1, w), detX = dot(cofactor, b), detPsi = dot(cofactor, g);
    // n.Q = d (n.v) + e (n.w),  n.(h1 x f3) = h1.(f3 x n),  n.(f1 x h3) = h3.(n x f1)
    const Pair d = dot(f.f1, f.f3), e = dot(f.f2, f.f3), nv = dot(n, v), nw = dot(n, w);
    const Vec3<Pair> f3n = cross(f.f3, n), nf1 = cross(n, f.f1), nf2 = cross(n, f.f2);
    // gradient of n.Q with respect to the rows of F
    const Rows<Pair> gradient{nv * f.f3 + d * f3n, nw * f.f3 + e * f3n, nv * f.f1 + nw * f.f2 + (d * nf1 + e * nf2)};
    const Pair q = d * nv + e * nw, qX = dot(gradient, b), qPsi = dot(gradient, g);
    const Pair inverse = 1 / (detX * qPsi - detPsi * qX);
    const Pair dx = inverse * (q * detPsi - det * qPsi), dpsi = inverse * (det * qX - q * detX);
    const Pair newC = c - dpsi * s, newS = s + dpsi * c;
    for (int lane = 0; lane < 2; ++lane) {
      if (!running[lane]) continue;
      const double turn = std::abs(dpsi[lane]), shift = std::abs(dx[lane]);
      running[lane] = turn < 1 && std::isfinite(shift);
      if (!running[lane]) continue;
      x[lane] += dx[lane];
      c[lane] = newC[lane];
      s[lane] = newS[lane];
      const double step = shift / (1 + std::abs(x[lane])) + turn;
      converged[lane] = step < 1e-9 || (step < 1e-7 && step >= last[lane]);
      running[lane] = !converged[lane];
      last[lane] = step;
    }
    if (!running[0] && !running[1]) break;
  }
  return {{converged[0], converged[1]}};
}

bool isNew(const OneFocalMotion& motion, const OneFocalMotion* motions, int count) {
  constexpr double kSame = 1e-7;
  for (int i = 0; i < count; ++i)
    if (std::abs(motion.focalLength / motions[i].focalLength - 1) < kSame &&
        (motion.rotation - motions[i].rotation).squaredNorm() < kSame * kSame)
      return false;
  return true;
}

}  // namespace

bool SixCorrespondences::normalize() {
  imageScale = 0;
  for (int k = 0; k < kSix; ++k) imageScale = std::max({imageScale, std::abs(u[k]), std::abs(v[k])});
  if (!(imageScale > 0)) return false;
  for (int k = 0; k < kSix; ++k) {
    u[k] /= imageScale;
    v[k] /= imageScale;
  }
  return true;
}

bool SixCorrespondences::setRays(const RayMatch* rays) {
  for (int k = 0; k < kSix; ++k) set(k, rays[k].u, rays[k].v, rays[k].direction);
  return normalize();
}

int oneFocalFundamental(const SixCorrespondences& correspondences, OneFocalMotion* motions) {
  constexpr double kLeastFocalLength = 5e-4;  // of the largest image coordinate; what lies below belongs to f = 0
  OneFocalPencil pencil;
  if (!pencil.build(correspondences)) return 0;
  math::Direction roots[kMaxRoots];
  Candidates candidates = findCandidates(pencil, roots, rootDirections(pencil, correspondences, roots));
  candidates.pad();
  int count = 0;
  for (int i = 0; i < candidates.count; i += 2) {
    Pair x = math::load<Pair>(candidates.x + i), c = math::load<Pair>(candidates.c + i), s = math::load<Pair>(candidates.s + i);
    const Converged converged = refine(pencil, x, c, s);
    const OneFocalDecomposition decomposition(pencil.at(x, c, s));
    const OneFocalOrientation orientation(correspondences, decomposition);
    for (int lane = 0; lane < 2 && i + lane < candidates.count; ++lane) {
      if (!converged.lane[lane] || !(decomposition.focal[lane] > kLeastFocalLength)) continue;
      OneFocalMotion motion;
      if (!orientation.motion(decomposition, lane, motion) || !isNew(motion, motions, count)) continue;
      // More than the equations' degree: they have a continuum of solutions.
      if (count == kMaxOneFocalMotions) return 0;
      motions[count++] = motion;
    }
  }
  return count;
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv
