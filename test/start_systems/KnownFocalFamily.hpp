// Problems with known focal length as problems of H70f, see KnownSystem.hpp: six rays, and in the place of the seventh the
// equation alpha beta = 1, with image points in units of the focal length. A point is two rays through it, seen at one image point.
#pragma once

#include "solvers/complex_rays/Frame.hpp"
#include "start_systems/H70fFamily.hpp"

namespace hybridgv {
namespace test {

struct KnownFocalSystem : H70fFamily::PathProblem::System {
  template <bool derivative, class V>
  static void evaluate(const Homotopy<math::Real<V>>& homotopy, V t, const Data<V>& data, const math::Complex<V> (&z)[kUnknowns],
                       math::Complex<V> (&rows)[kUnknowns][kUnknowns + 1 + derivative]) {
    H70fFamily::PathProblem::System::evaluate<derivative>(homotopy, t, data, z, rows);
    math::Complex<V>(&row)[kUnknowns + 1 + derivative] = rows[kUnknowns - 1];
    for (math::Complex<V>& entry : row) entry = {V{}, V{}};
    row[Alpha] = row[Beta] = z[Alpha] * z[Beta];
    row[F] = {row[Alpha].re - 1, row[Alpha].im};
  }
};

struct KnownFocalFamily {
  struct PathProblem {
    using System = KnownFocalSystem;
  };
  // Points take the first rows, two each. A camera that has several rays is the first, and its centre the origin.
  struct Sharing {
    std::vector<int> raysPerCamera;
    int points;

    int sharedRays() const { return !raysPerCamera.empty() && raysPerCamera[0] > 1 ? raysPerCamera[0] : 0; }
  };
  using Parameters = H70fFamily::Parameters;

  static solvers::complex_rays::Frame frameOf(const Sharing& sharing, const MinimalProblem& problem);
  static Parameters parametersIn(const solvers::complex_rays::Frame& frame, const MinimalProblem& problem);

  static KnownSystem<KnownFocalFamily> randomRealSystem(const Sharing& sharing, Random& random);
  static auto straightHomotopy(const Parameters& start, const Parameters& target) {
    return solvers::h70f::straightHomotopy(start, target);
  }
  template <class Function>
  static void forEachNumber(Parameters& parameters, Function f) {
    forEachNumberOfRays(parameters, f);
  }
  // Also makes the two rays of a point meet again.
  static void restoreSharedCentres(const Sharing& sharing, Parameters* parameters);
};

}  // namespace test
}  // namespace hybridgv
