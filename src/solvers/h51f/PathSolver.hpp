// The two passes of the path tracking of H51f:
//
//   1  all paths in single precision; end points that may be real, doubtful or double are polished in double precision
//   2  paths that failed, did not converge, ended on an improper solution or on the same one as another path are tracked again in
//      double precision with pivoting and small steps. That may reveal yet another path on a wrong end: where solutions are close
//      together, several paths may have taken each other's ends. Hence a number of rounds, the first three more careful each
//
// Compiled once per instruction set, see math/simd/Lanes.hpp.
#pragma once

#include "solvers/h51f/System.hpp"
#include "solvers/h51f/solvePaths.hpp"

namespace hybridgv {
namespace HYBRIDGV_INSTRUCTION_SET {

namespace h51f = solvers::h51f;

class PathSolver {
 public:
  PathSolver(const h51f::StartSystem& start, const h51f::Parameters& target)
      : start_(start),
        homotopy_(h51f::straightHomotopy(start.parameters, target)),
        pointImage_(scalar(target.pointImage)),
        pointImageBar_(scalar(target.pointImageBar)),
        hasInfiniteSolutions_(hasImageAtPrincipalPoint(target)) {}

  // The number of steps of every path in the first pass; the largest number for those that fail.
  void countSteps(int* steps) {
    PathEnd<float, h51f::kUnknowns> ends[h51f::kMaxPaths];
    firstPass(ends);
    for (int i = 0; i < start_.paths; ++i) steps[i] = ends[i].reached ? ends[i].attempts : kFirstPass.attempts;
  }

  void solve(h51f::EndPoints* ends) {
    ends->paths = start_.paths, ends->accepted = 0, ends->count = 0, ends->steps = 0;
    PathEnd<float, N> first[kMaxPaths];
    firstPass(first);
    for (int i = 0; i < start_.paths; ++i) ends->steps += first[i].attempts;
    giveUpInfinitePaths();
    sortOut();
    if (countOf(State::Bad) + countOf(State::AtInfinity) > kHopeless * start_.paths) return;
    for (int round = 0, spent = 0; round < h51f::kRounds && countOf(State::Bad) > 0 && spent < h51f::kMaxStepsPerRound; ++round) {
      const int steps = secondPass(round);
      spent += steps, ends->steps += steps;
    }
    if (polishFailed()) sortOut();
    collect(ends);
  }

 private:
  static constexpr int N = h51f::kUnknowns, kMaxPaths = h51f::kMaxPaths;
  static constexpr TrackingOptions kFirstPass{2.5e-2, 0.15, 1e-2, 0.08, 0.3, 1e-6, h51f::kMaxStepsFirstPass};
  static constexpr double kHopeless = 0.8;         // share of bad paths that only degenerate data have
  static constexpr double kCentral = 1e-7;         // distance from the principal point; 1/4 is the mean
  static constexpr double kHuge = 1e5;             // size of the unknowns or their reciprocals that counts as infinite
  static constexpr double kFloatConverged = 1e-4;  // last Newton step in single precision
  static constexpr double kFloatReal = 3e-2;       // single precision solutions that are this close to real may be real
  static constexpr double kFloatDistinct = 1e-2;
  static constexpr double kConverged = 1e-8, kAlmostConverged = 1e-6, kDistinct = 1e-6, kReal = 1e-6, kImproper = 1e-7,
                          kFloatImproper = 1e-3;

  using Scalar = Complex<double>;
  using DoublePoint = Point<double, N>;
  using FirstTracker = PathTracker<H51fSystem, Floats, Pivoting::None>;
  using SecondTracker = PathTracker<H51fSystem, Doubles, Pivoting::Rows>;

  enum class State {
    Single,  // a solution, known to single precision and not real
    Double,  // a solution to double precision
    Bad,
    AtInfinity,  // bad, and not worth another round
  };

  static Scalar scalar(const h51f::ComplexNumber& a) { return {a.re, a.im}; }
  Scalar at(int i, int k) const { return {point_[i].re[k], point_[i].im[k]}; }
  static double norm(const Scalar& a) { return __builtin_sqrt(squaredNorm(a)); }

  int countOf(State state) const {
    int count = 0;
    for (int i = 0; i < start_.paths; ++i) count += state_[i] == state;
    return count;
  }

  // --- first pass

  template <int Degree>
  static void narrow(const math::Polynomial<double, Degree>& from, math::Polynomial<float, Degree>& to) {
    for (int k = 0; k <= Degree; ++k) to.re[k] = static_cast<float>(from.re[k]), to.im[k] = static_cast<float>(from.im[k]);
  }
  static void narrow(const h51f::VectorHomotopy<double>& from, h51f::VectorHomotopy<float>& to) {
    narrow(from.plus, to.plus), narrow(from.minus, to.minus), narrow(from.third, to.third);
  }
  static void narrow(const h51f::Homotopy<double>& from, h51f::Homotopy<float>& to) {
    narrow(from.pointImage, to.pointImage), narrow(from.pointImageBar, to.pointImageBar);
    for (int j = 0; j < h51f::kRays; ++j) {
      narrow(from.ray[j].direction, to.ray[j].direction), narrow(from.ray[j].moment, to.ray[j].moment);
      narrow(from.ray[j].image, to.ray[j].image), narrow(from.ray[j].imageBar, to.ray[j].imageBar);
      narrow(from.ray[j].cross, to.ray[j].cross);
    }
  }

  void firstPass(PathEnd<float, N>* ends) {
    h51f::Homotopy<float> homotopy;
    narrow(homotopy_, homotopy);
    Point<float, N> tangents[kMaxPaths], reached[kMaxPaths];
    int all[kMaxPaths] = {};
    float lastStep[kMaxPaths];
    for (int i = 0; i < start_.paths; ++i) all[i] = i;
    FirstTracker::startTangents(homotopy, start_.solutions, all, start_.paths, tangents);
    FirstTracker::track(homotopy, start_.solutions, tangents, all, start_.paths, kFirstPass, ends);
    for (int i = 0; i < start_.paths; ++i) reached[i] = ends[i].point;
    newtonSteps<H51fSystem, Floats, Pivoting::None>(homotopy, 1, reached, all, start_.paths, 1, 0.0f, lastStep);
    for (int i = 0; i < start_.paths; ++i) {
      for (int k = 0; k < N; ++k) point_[i].re[k] = reached[i].re[k], point_[i].im[k] = reached[i].im[k];
      state_[i] = ends[i].reached ? State::Single : State::Bad;
      lastStep_[i] = 1;
      doubtful_[i] = !(lastStep[i] < kFloatConverged);
    }
  }

  // --- judging end points

  // An image point at the principal point moves solutions to infinity, and single precision follows their paths far enough. Huge
  // unknowns alone are no proof.
  void giveUpInfinitePaths() {
    if (!hasInfiniteSolutions_) return;
    for (int i = 0; i < start_.paths; ++i)
      if (state_[i] == State::Bad && isHuge(i)) state_[i] = State::AtInfinity;
  }
  static bool hasImageAtPrincipalPoint(const h51f::Parameters& target) {
    bool has = norm(scalar(target.pointImage)) < kCentral;
    for (const h51f::ComplexNumber& image : target.image) has = has || norm(scalar(image)) < kCentral;
    return has;
  }
  bool isHuge(int i) const {
    bool huge = false;
    for (int k = 0; k < N; ++k) {
      const double size = squaredNorm(at(i, k));
      huge = huge || size > kHuge * kHuge || (k >= H51fSystem::kAbsolute && size * kHuge * kHuge < 1);
    }
    return huge;
  }

  // Whether the end points differ by less than the tolerance, relative to their size.
  bool coincide(int i, int j, double tolerance) const {
    for (int k = 0; k < N; ++k)
      if (squaredNorm(at(i, k) - at(j, k)) > tolerance * tolerance * (1 + squaredNorm(at(i, k)))) return false;
    return true;
  }

  bool isReal(int i, double tolerance) const {
    const Scalar x = at(i, H51fSystem::X), alpha = at(i, H51fSystem::Alpha), d = at(i, H51fSystem::D);
    return norm(at(i, H51fSystem::Y) - conjugate(x)) < tolerance * (1 + norm(x)) &&
           norm(at(i, H51fSystem::Beta) - conjugate(alpha)) < tolerance * norm(alpha) &&
           __builtin_fabs(d.im) < tolerance * norm(d);
  }

  // Where three or more rays share a centre c = (0, 0, kSharedCentre), a query at c satisfies their equations: n.c + d = 0, z.c +
  // d pi0 = 0 and its conjugate.
  bool isImproper(int i, double tolerance) const {
    if (start_.sharing == h51f::Sharing::AtMostTwo) return false;
    const Scalar x = at(i, H51fSystem::X), y = at(i, H51fSystem::Y), d = at(i, H51fSystem::D), xy = x * y, one{1, 0};
    const Scalar scale = reciprocal(one + xy);
    const double c = h51f::kSharedCentre;
    return norm(c * ((one - xy) * scale) + d) < tolerance &&
           norm(pointImage_ * d - 2 * c * (x * scale * reciprocal(at(i, H51fSystem::Beta)))) < tolerance &&
           norm(pointImageBar_ * d - 2 * c * (y * scale * reciprocal(at(i, H51fSystem::Alpha)))) < tolerance;
  }

  void polish(const int* indices, int count, int steps = kPolishSteps) {
    newtonSteps<H51fSystem, Doubles, Pivoting::Rows>(homotopy_, 1, point_, indices, count, steps, kConverged, lastStep_);
    for (int i = 0; i < count; ++i) state_[indices[i]] = lastStep_[indices[i]] < kConverged ? State::Double : State::Bad;
  }
  template <class Condition>
  void polishSinglesIf(Condition condition) {
    int chosen[kMaxPaths] = {}, count = 0;
    for (int i = 0; i < start_.paths; ++i)
      if (state_[i] == State::Single && condition(i)) chosen[count++] = i;
    polish(chosen, count);
  }
  bool isNearAnother(int i) const {
    for (int j = 0; j < start_.paths; ++j)
      if (j != i && !isBad(j) && coincide(i, j, kFloatDistinct)) return true;
    return false;
  }

  // Polishes what single precision cannot decide and finds what is bad. A doubtful end may move to another one.
  void sortOut() {
    polishSinglesIf([this](int i) {
      return doubtful_[i] || isImproper(i, kFloatImproper) || (isReal(i, kFloatReal) && point_[i].re[H51fSystem::D] > 0);
    });
    polishSinglesIf([this](int i) { return isNearAnother(i); });
    for (int i = 0; i < start_.paths; ++i)
      if (state_[i] == State::Double && isImproper(i, kImproper)) state_[i] = State::Bad;
    bool twin[kMaxPaths] = {};
    for (int i = 0; i < start_.paths; ++i)
      for (int j = 0; j < i; ++j)
        if (state_[i] == State::Double && state_[j] == State::Double && coincide(i, j, kDistinct)) twin[i] = twin[j] = true;
    for (int i = 0; i < start_.paths; ++i) twin_[i] = twin[i];
    for (int i = 0; i < start_.paths; ++i)
      if (twin[i]) state_[i] = State::Bad;
  }
  bool isBad(int i) const { return state_[i] == State::Bad || state_[i] == State::AtInfinity; }

  // --- second pass

  // Returns the number of steps.
  int secondPass(int round) {
    int bad[kMaxPaths] = {}, count = 0;
    for (int i = 0; i < start_.paths; ++i)
      if (state_[i] == State::Bad) bad[count++] = i;
    DoublePoint starts[kMaxPaths], tangents[kMaxPaths];
    PathEnd<double, N> ends[kMaxPaths];
    double lastStep[kMaxPaths];
    int all[kMaxPaths] = {};
    for (int i = 0; i < count; ++i) {
      all[i] = i;
      for (int k = 0; k < N; ++k)
        starts[i].re[k] = start_.solutions[bad[i]].re[k], starts[i].im[k] = start_.solutions[bad[i]].im[k];
    }
    newtonSteps<H51fSystem, Doubles, Pivoting::Rows>(homotopy_, 0, starts, all, count, kPolishSteps, kConverged, lastStep);
    SecondTracker::startTangents(homotopy_, starts, all, count, tangents);
    const double tolerance = round == 0 ? 4e-3 : round == 1 ? 4e-4 : 4e-5, acceptSecond = 0.05 * tolerance;
    const int share = h51f::kMaxStepsPerRound / count;
    const TrackingOptions options{tolerance,
                                  5 * tolerance,
                                  acceptSecond,
                                  0.02,
                                  0.2,
                                  1e-12,
                                  share < h51f::kMaxStepsSecondPass ? share : h51f::kMaxStepsSecondPass};
    SecondTracker::track(homotopy_, starts, tangents, all, count, options, ends);
    int reached[kMaxPaths] = {}, countReached = 0, steps = 0;
    for (int i = 0; i < count; ++i) {
      steps += ends[i].attempts;
      point_[bad[i]] = ends[i].point;
      state_[bad[i]] = isHuge(bad[i]) || round > 0 ? State::AtInfinity : State::Bad;
      if (ends[i].reached) reached[countReached++] = bad[i];
    }
    polish(reached, countReached);
    sortOut();
    return steps;
  }

  // --- result

  // A path to a solution that is almost double may fail shortly before its end, but close enough for Newton's method, which takes
  // many steps there. Returns whether there are such paths.
  bool polishFailed() {
    int finite[kMaxPaths] = {}, count = 0;
    for (int i = 0; i < start_.paths; ++i) {
      const bool slow = state_[i] == State::Bad && !(lastStep_[i] < kConverged);
      if (slow || (state_[i] == State::AtInfinity && !isHuge(i))) finite[count++] = i;
    }
    polish(finite, count, kManyPolishSteps);
    return count > 0;
  }

  void collect(h51f::EndPoints* ends) {
    for (int i = 0; i < start_.paths; ++i) keepOneTwin(i);
    for (int i = 0; i < start_.paths; ++i) {
      ends->accepted += !isBad(i);
      if (isKnown(i) && isReal(i, kReal) && point_[i].re[H51fSystem::D] > 0) ends->point[ends->count++] = point_[i];
    }
  }

  // Newton's method converges slowly, and not fully, to a solution that is almost double: of the pair, one is good enough.
  bool isKnown(int i) const {
    if (state_[i] == State::Double) return true;
    if (state_[i] != State::Bad || lastStep_[i] < kConverged || !(lastStep_[i] < kAlmostConverged)) return false;
    for (int j = 0; j < i; ++j)
      if (isKnown(j) && coincide(i, j, kAlmostConverged)) return false;
    return true;
  }

  // Of paths that ended on the same solution, the first counts.
  void keepOneTwin(int i) {
    if (!twin_[i]) return;
    for (int j = 0; j < i; ++j)
      if (twin_[j] && coincide(i, j, kDistinct)) return;
    state_[i] = State::Double;
  }

  static constexpr int kPolishSteps = 6, kManyPolishSteps = 30;

  const h51f::StartSystem& start_;
  const h51f::Homotopy<double> homotopy_;
  const Scalar pointImage_, pointImageBar_;
  const bool hasInfiniteSolutions_;
  DoublePoint point_[kMaxPaths];
  double lastStep_[kMaxPaths];  // of the last polish
  State state_[kMaxPaths];
  bool doubtful_[kMaxPaths], twin_[kMaxPaths] = {};
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace hybridgv
