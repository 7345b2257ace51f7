// Poses with unknown focal length that see three given points and satisfy one equation more: H13f, P3.5Pf and P4Pf.
//
// On the four sheets over the circle of angles phi (ThreePointSheets.hpp) the additional equation is eliminated to one binary
// form p(cos phi, sin phi), the product of its values on the sheets. Each real root of p is lifted to the sheet where the
// equation holds and refined there.
#pragma once

#include "math/roots/BinaryFormRoots.hpp"
#include "solvers/three_points/FrontoParallel.hpp"
#include "solvers/three_points/ThreePointRefinement.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {

// The additional equation:
//
//   static constexpr int kDegree;              degree of the form p
//   T product(Sheets<T>, Sheet<T>, Sheet<T>)   p at an angle (T = Pair: at two) with two real eta
//   double norm(Sheets<double>, Sheet<Complex>)    p at an angle with a conjugate pair of eta
//   Residual residual(Sheets<double>, Sheet<double>, n3, rho)
//   WithGradient<double> constraint(SurfacePoint)
//   double frontoParallelStart(side)           d for u = v = 0
//   Row frontoParallelConstraint(FrontoParallelPoint)
//   double rank(FramePose)                     negative: the pose does not satisfy the equation; otherwise poses are returned in
//                                              order of increasing rank

// Value of the equation at a candidate and the sum of the magnitudes of its terms.
struct Residual {
  double value, magnitude;
};

template <std::size_t N>
Residual sumOfTerms(const double (&terms)[N]) {
  Residual result{0, 0};
  for (double term : terms) {
    result.value += term;
    result.magnitude += std::abs(term);
  }
  return result;
}

template <class Equation>
class ThreePointSolver {
 public:
  ThreePointSolver(const ThreePointFrame& frame, const Equation& equation, FocalPose* solutions)
      : frame_(frame), equation_(equation), solutions_(solutions) {}

  int solve() {
    for (double side : {1.0, -1.0})
      if (isFrontoParallel(frame_, side)) searchFrontoParallel(side);
    using Roots = math::BinaryFormRoots<Equation::kDegree>;
    math::Direction roots[Roots::kMaxRoots];
    const int count = Roots::findSampled(
        [this](const double* c, const double* s, double* p) {
          for (int j = 0; j < Roots::kPadded; j += 2) samplePair(c + j, s + j, p + j);
        },
        roots);
    for (int i = 0; i < count; ++i) lift(roots[i]);
    return count_;
  }

 private:
  struct Candidate {
    double n3, rho, eta, quality;
  };

  // The form at two directions.
  void samplePair(const double* c, const double* s, double* p) const {
    const Sheets<Pair> at(frame_, math::load<Pair>(c), math::load<Pair>(s));
    const Pair discriminant = at.discriminant();
    Pair first, second;
    at.realRoots(discriminant, first, second);
    math::store(p, equation_.product(at, Sheet<Pair>(frame_, at, first), Sheet<Pair>(frame_, at, second)));
    for (int lane = 0; lane < 2; ++lane)
      if (discriminant[lane] < 0) p[lane] = sampleComplex(c[lane], s[lane]);
  }

  double sampleComplex(double c, double s) const {
    const Sheets<double> at(frame_, c, s);
    return equation_.norm(at, Sheet<Complex>(frame_, at, at.complexRoot(at.discriminant())));
  }

  void lift(const math::Direction& root) {
    const Sheets<double> at(frame_, root.c, root.s);
    const double discriminant = at.discriminant();
    Candidate candidates[2];
    int count = 0;
    if (discriminant > 0) {
      double first, second;
      at.realRoots(discriminant, first, second);
      count += makeCandidate(at, first, candidates[count]);
      count += makeCandidate(at, second, candidates[count]);
    } else {
      count += makeCandidate(at, -at.w1 / (2 * at.w2), candidates[count]);
    }
    for (int i = 0; i < count; ++i) {
      const Candidate& candidate = candidates[i];
      if (count == 2 && candidate.quality > 1000 * candidates[1 - i].quality) continue;
      SurfacePoint point;
      point.c = root.c;
      point.s = root.s;
      point.n3 = candidate.n3;
      point.rho = candidate.rho;
      point.eta = candidate.eta;
      if (refine(point, frame_, [this](const SurfacePoint& p) { return equation_.constraint(p); })) add(point.pose(frame_));
    }
  }

  bool makeCandidate(const Sheets<double>& at, double eta, Candidate& candidate) const {
    const double depth1 = eta + at.c * frame_.a1, depth2 = eta + at.c * frame_.b1, depth3 = eta - at.s * frame_.h;
    const bool allPositive = depth1 > 0 && depth2 > 0 && depth3 > 0, allNegative = depth1 < 0 && depth2 < 0 && depth3 < 0;
    if (!allPositive && !allNegative) return false;
    const Sheet<double> sheet(frame_, at, eta);
    const double n3 = sheet.n3(), square = (sheet.S - sheet.R) / sheet.S;
    if (!(square > -0.05)) return false;
    const double rho = std::copysign(std::sqrt(std::max(square, 0.0)), allPositive ? 1.0 : -1.0);
    const double scale = 1 / std::sqrt(n3 * n3 + rho * rho);
    candidate = {n3 * scale, rho * scale, eta, 0};
    const Residual residual = equation_.residual(at, sheet, candidate.n3, candidate.rho);
    candidate.quality = std::abs(residual.value) / residual.magnitude;
    return candidate.quality < kCandidateTolerance;
  }

  void searchFrontoParallel(double side) {
    FrontoParallelPoint point{};
    point.d = equation_.frontoParallelStart(side);
    const auto constraint = [this](const FrontoParallelPoint& p) { return equation_.frontoParallelConstraint(p); };
    if (std::isfinite(point.d) && refineFrontoParallel(point, frame_, side, constraint)) add(point.pose(frame_));
  }

  void add(const FramePose& pose) {
    if (!seesThreePoints(pose, frame_)) return;
    const double rank = equation_.rank(pose);
    if (!(rank >= 0)) return;
    for (int i = 0; i < count_; ++i)
      if ((found_[i].r3 - pose.r3).cwiseAbs().sum() < 1e-7 && std::abs(found_[i].f / pose.f - 1) < 1e-7) return;
    if (count_ == Equation::kDegree) return;
    int place = count_++;
    for (; place > 0 && ranks_[place - 1] > rank; --place) {
      ranks_[place] = ranks_[place - 1];
      found_[place] = found_[place - 1];
      solutions_[place] = solutions_[place - 1];
    }
    ranks_[place] = rank;
    found_[place] = pose;
    solutions_[place] = pose.inRig(frame_);
  }

  // A candidate whose equation is violated by more than this share of its terms is on the wrong sheet.
  static constexpr double kCandidateTolerance = 1e-3;

  const ThreePointFrame& frame_;
  const Equation& equation_;
  FocalPose* solutions_;
  int count_ = 0;
  FramePose found_[Equation::kDegree];
  double ranks_[Equation::kDegree];
};

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv
