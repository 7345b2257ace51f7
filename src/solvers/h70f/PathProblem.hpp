// H70f for the path solver (math/homotopy/PathSolver.hpp). Compiled once per instruction set, see math/simd/Lanes.hpp.
#pragma once

#include "math/homotopy/PathSolver.hpp"
#include "solvers/h70f/Problem.hpp"
#include "solvers/h70f/System.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;
using namespace complex_rays;

// The way from a start system to the target. Refers to both.
class H70fPathProblem {
 public:
  using System = H70fSystem;
  using Solution = Point<double, System::kUnknowns>;
  static constexpr int kMaxPaths = h70f::kMaxPaths;

  H70fPathProblem(const StartSystem& start, const Parameters& target)
      : start_(start),
        target_(target),
        hasFirstGroup_(start.sharing != Sharing::AtMostTwo),
        hasSecondGroup_(start.sharing == Sharing::ThreeThree || start.sharing == Sharing::FourThree) {}

  int paths() const { return start_.paths; }
  const Point<float, System::kUnknowns>* starts() const { return start_.solutions; }
  System::Homotopy<double> homotopy() const { return straightHomotopy(start_.parameters, target_); }

  static System::Homotopy<float> singlePrecision(const System::Homotopy<double>& from) {
    System::Homotopy<float> to;
    for (int j = 0; j < System::kRays; ++j) narrow(from.ray[j], &to.ray[j]);
    return to;
  }

  // An image point at the principal point moves solutions to infinity.
  bool hasInfiniteSolutions() const {
    bool has = false;
    for (const ComplexNumber& image : target_.image) has = has || squaredNorm(Scalar{image.re, image.im}) < kCentral * kCentral;
    return has;
  }

  // The camera's: y = conj x, beta = conj alpha, taub = conj tau, real t3.
  static bool isReal(const Solution& solution, double tolerance) {
    const Scalar x = component(solution, System::X), y = component(solution, System::Y);
    const Scalar alpha = component(solution, System::Alpha), beta = component(solution, System::Beta);
    const Scalar tau = component(solution, System::Tau), tauBar = component(solution, System::TauBar);
    const Scalar t3 = component(solution, System::T3);
    return norm(y - conjugate(x)) < tolerance * (1 + norm(x)) && norm(beta - conjugate(alpha)) < tolerance * norm(alpha) &&
           norm(tauBar - conjugate(tau)) < tolerance * (1 + norm(tau)) && __builtin_fabs(t3.im) < tolerance * (1 + norm(t3));
  }

  // Where three or more rays share a centre c, a query at c satisfies their equations: t = -R c.
  bool isImproper(const Solution& solution, double tolerance) const {
    return (hasFirstGroup_ && isAtThirdAxis(solution, 0, tolerance)) ||
           (hasSecondGroup_ && isAtThirdAxis(solution, kSecondCentre, tolerance));
  }

  bool isUseful(const Solution&) const { return true; }

 private:
  using Scalar = Complex<double>;
  static constexpr double kCentral = 1e-7;  // distance from the principal point; 1/4 is the mean

  static double norm(const Scalar& a) { return __builtin_sqrt(squaredNorm(a)); }

  // Whether the query is at (0, 0, c):  tau (1+xy) + u(c) = 0, taub (1+xy) + v(c) = 0, t3 (1+xy) + s(c) = 0.
  static bool isAtThirdAxis(const Solution& solution, double c, double tolerance) {
    const Scalar x = component(solution, System::X), y = component(solution, System::Y), xy = x * y, one{1, 0};
    const Scalar scale = reciprocal(one + xy);
    return norm(component(solution, System::Tau) - 2 * c * (x * scale)) < tolerance &&
           norm(component(solution, System::TauBar) - 2 * c * (y * scale)) < tolerance &&
           norm(component(solution, System::T3) + c * ((one - xy) * scale)) < tolerance;
  }

  const StartSystem& start_;
  const Parameters& target_;
  const bool hasFirstGroup_, hasSecondGroup_;
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
