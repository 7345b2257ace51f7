// From a fundamental matrix F = diag(1/f, 1/f, 1) E to the focal length and the relative pose; two matrices at once.
#pragma once

#include "math/Vec3.hpp"
#include "solvers/one_centre/OneFocalFundamental.hpp"
#include "solvers/one_centre/OneFocalPencil.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

// 1 or -1
inline math::Pair signs(math::Pair a) { return math::select<math::Pair>(a < 0, math::Pair{-1, -1}, math::Pair{1, 1}); }

// |f3|^4 / f^2 = |f1 x f3|^2 + |f2 x f3|^2 - (f1.f3)^2 - (f2.f3)^2 as minuend and subtrahend.
template <class T>
struct FocalDenominator {
  T minuend, subtrahend;

  explicit FocalDenominator(const Rows<T>& f) {
    const math::Vec3<T> v = cross(f.f1, f.f3), w = cross(f.f2, f.f3);
    const T d = dot(f.f1, f.f3), e = dot(f.f2, f.f3);
    minuend = dot(v, v) + dot(w, w);
    subtrahend = d * d + e * e;
  }
};

// f, then E = diag(f, f, 1) F of squared norm 2, b its unit right null vector, R = cof(E) - E [b]x, so that E = +-[R b]x R. The
// other rotation with this property is (2 (R b)(R b)^T - I) R; b may have either sign.
struct OneFocalDecomposition {
  math::Pair focal;
  Rows<math::Pair> rotation;
  math::Vec3<math::Pair> baseline, baselineInQuery;  // b, R b

  explicit OneFocalDecomposition(const Rows<math::Pair>& f) {
    using math::Pair;
    const FocalDenominator<Pair> denominator(f);
    const Pair ff = dot(f.f3, f.f3);
    focal = ff / math::squareRoot(denominator.minuend - denominator.subtrahend);
    const Pair scale = math::squareRoot(2 / (focal * focal * (dot(f.f1, f.f1) + dot(f.f2, f.f2)) + ff)), scaleF = scale * focal;
    const Rows<Pair> E{scaleF * f.f1, scaleF * f.f2, scale * f.f3};
    // cof(E) = (R b) b^T
    const Rows<Pair> cof = cofactors(E);
    const Pair sign2 = signs(dot(cof.f1, cof.f2)), sign3 = signs(dot(cof.f1 + sign2 * cof.f2, cof.f3));
    const math::Vec3<Pair> sum = cof.f1 + sign2 * cof.f2 + sign3 * cof.f3;
    baseline = (1 / math::squareRoot(dot(sum, sum))) * sum;
    rotation = {cof.f1 + cross(baseline, E.f1), cof.f2 + cross(baseline, E.f2), cof.f3 + cross(baseline, E.f3)};
    baselineInQuery = {dot(rotation.f1, baseline), dot(rotation.f2, baseline), dot(rotation.f3, baseline)};
  }
};

// Which of the two rotations and of the two signs of b puts all points in front of both cameras: at most one of the four does.
//
// For t = R b or -R b towards the calibrated camera's centre the conditions of meetInFront.hpp hold: n.(p x t) < 0 and
// n.(a x t) < 0, a = R q, n = p x a, with the same margin.
class OneFocalOrientation {
 public:
  OneFocalOrientation(const SixCorrespondences& correspondences, const OneFocalDecomposition& decomposition);
  // The pose of one lane; false if there is none.
  bool motion(const OneFocalDecomposition& decomposition, int lane, OneFocalMotion& result) const;

 private:
  // Whether both products of all points seen so far have the sign -sign.
  struct Choice {
    math::Pair sign;
    math::PairMask valid;

    void add(bool first, math::Pair pp, math::Pair nn, math::Pair npt, math::Pair nat);
    bool isAlive() const { return math::any(valid); }
  };
  Choice choices_[2];  // R and the other rotation
};

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv
