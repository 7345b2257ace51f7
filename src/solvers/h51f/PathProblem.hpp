// H51f for the path solver (math/homotopy/PathSolver.hpp). Compiled once per instruction set, see math/simd/Lanes.hpp.
#pragma once

#include "math/homotopy/PathSolver.hpp"
#include "solvers/h51f/Problem.hpp"
#include "solvers/h51f/System.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;
using namespace complex_rays;

// The way from a start system to the target. Refers to both.
class H51fPathProblem {
 public:
  using System = H51fSystem;
  using Solution = Point<double, System::kUnknowns>;
  static constexpr int kMaxPaths = h51f::kMaxPaths;

  H51fPathProblem(const StartSystem& start, const Parameters& target)
      : start_(start),
        target_(target),
        pointImage_(scalar(target.pointImage)),
        pointImageBar_(scalar(target.pointImageBar)),
        mayMeetSharedCentre_(start.sharing != Sharing::AtMostTwo) {}

  int paths() const { return start_.paths; }
  const Point<float, System::kUnknowns>* starts() const { return start_.solutions; }
  System::Homotopy<double> homotopy() const { return straightHomotopy(start_.parameters, target_); }

  static System::Homotopy<float> singlePrecision(const System::Homotopy<double>& from) {
    System::Homotopy<float> to;
    to.pointImage = narrowed(from.pointImage);
    to.pointImageBar = narrowed(from.pointImageBar);
    for (int j = 0; j < System::kRays; ++j) {
      narrow(from.ray[j], &to.ray[j]);
      to.ray[j].cross = narrowed(from.ray[j].cross);
    }
    return to;
  }

  // An image point at the principal point moves solutions to infinity.
  bool hasInfiniteSolutions() const {
    bool has = norm(pointImage_) < kCentral;
    for (const ComplexNumber& image : target_.image) has = has || norm(scalar(image)) < kCentral;
    return has;
  }

  // The camera's: y = conj x, beta = conj alpha, real d.
  bool isReal(const Solution& solution, double tolerance) const {
    const Scalar x = component(solution, System::X), y = component(solution, System::Y);
    const Scalar alpha = component(solution, System::Alpha), beta = component(solution, System::Beta);
    const Scalar d = component(solution, System::D);
    return norm(y - conjugate(x)) < tolerance * (1 + norm(x)) && norm(beta - conjugate(alpha)) < tolerance * norm(alpha) &&
           __builtin_fabs(d.im) < tolerance * norm(d);
  }

  // Where three or more rays share a centre c = (0, 0, kSharedCentre), a query at c satisfies their equations: n.c + d = 0, z.c +
  // d pi0 = 0 and its conjugate.
  bool isImproper(const Solution& solution, double tolerance) const {
    if (!mayMeetSharedCentre_) return false;
    const Scalar x = component(solution, System::X), y = component(solution, System::Y), xy = x * y, one{1, 0};
    const Scalar alpha = component(solution, System::Alpha), beta = component(solution, System::Beta);
    const Scalar d = component(solution, System::D), scale = reciprocal(one + xy);
    const double c = kSharedCentre;
    return norm(c * ((one - xy) * scale) + d) < tolerance &&
           norm(pointImage_ * d - 2 * c * (x * scale * reciprocal(beta))) < tolerance &&
           norm(pointImageBar_ * d - 2 * c * (y * scale * reciprocal(alpha))) < tolerance;
  }

  // With the 3D point in front of the query.
  bool isUseful(const Solution& solution) const { return solution.re[System::D] > 0; }

 private:
  using Scalar = Complex<double>;
  static constexpr double kCentral = 1e-7;  // distance from the principal point; 1/4 is the mean

  static Scalar scalar(const ComplexNumber& a) { return {a.re, a.im}; }
  static double norm(const Scalar& a) { return __builtin_sqrt(squaredNorm(a)); }

  const StartSystem& start_;
  const Parameters& target_;
  const Scalar pointImage_, pointImageBar_;
  const bool mayMeetSharedCentre_;
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
