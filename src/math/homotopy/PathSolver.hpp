// All solutions of a problem, by tracking those of a start system to it, in two passes:
//
//   1  all paths in single precision; end points that may be real, doubtful or double are polished in double precision
//   2  paths that failed, did not converge, ended on an improper solution or on the same one as another path are tracked again in
//      double precision with pivoting and small steps. That may reveal yet another path on a wrong end: where solutions are close
//      together, several paths may have taken each other's ends. Hence a number of rounds, the first three more careful each
//
// An object of the class Problem tells what is particular to a problem:
//   System                    the equations, see PathTracker.hpp; equations come in an order in which the first pass, which does
//                             not pivot, can eliminate
//   kMaxPaths                 the largest number of paths of any start system
//   paths(), starts()         the number of solutions of the start system, and these in single precision
//   homotopy()                the way from the start system (t = 0) to the problem (t = 1), a System::Homotopy<double>
//   singlePrecision(homotopy) static; the same way as a System::Homotopy<float>
//   hasInfiniteSolutions()    whether the data are known to move solutions to infinity
//   isReal(x, tolerance)      whether a solution belongs to a real one of the original unknowns
//   isImproper(x, tolerance)  whether x satisfies the equations of every problem with this start system, or of all but a few, and
//                             so is the end of no path: a path that leads there has taken a wrong turn
//   isUseful(x)               for real x: whether it is wanted, for example in front of the camera
//
// Compiled once per instruction set, see math/simd/Lanes.hpp.
#pragma once

#include "math/homotopy/EndPoints.hpp"
#include "math/homotopy/PathTracker.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

template <int N>
Complex<double> component(const Point<double, N>& point, int k) {
  return {point.re[k], point.im[k]};
}

template <int Degree>
Polynomial<float, Degree> narrowed(const Polynomial<double, Degree>& polynomial) {
  Polynomial<float, Degree> result;
  for (int k = 0; k <= Degree; ++k) {
    result.re[k] = static_cast<float>(polynomial.re[k]);
    result.im[k] = static_cast<float>(polynomial.im[k]);
  }
  return result;
}

template <class Problem>
class PathSolver {
 public:
  using System = typename Problem::System;
  static constexpr int N = System::kUnknowns;
  static constexpr int kMaxPaths = Problem::kMaxPaths;
  using EndPoints = math::EndPoints<N, kMaxPaths>;

  explicit PathSolver(const Problem& problem) : problem_(problem), homotopy_(problem.homotopy()), paths_(problem.paths()) {}

  // The number of steps of every path in the first pass; the largest number for those that fail.
  void countSteps(int* steps) {
    PathEnd<float, N> ends[kMaxPaths];
    firstPass(ends);
    for (int i = 0; i < paths_; ++i) steps[i] = ends[i].reached ? ends[i].attempts : kFirstPass.attempts;
  }

  void solve(EndPoints* ends) {
    ends->paths = paths_;
    ends->accepted = 0;
    ends->count = 0;
    ends->steps = 0;
    PathEnd<float, N> first[kMaxPaths];
    firstPass(first);
    for (int i = 0; i < paths_; ++i) ends->steps += first[i].attempts;
    giveUpInfinitePaths();
    sortOut();
    if (countOf(State::Bad) + countOf(State::AtInfinity) > kHopeless * paths_) return;
    int spent = 0;
    for (int round = 0; round < kMaxRounds && countOf(State::Bad) > 0 && spent < kMaxStepsPerRound; ++round)
      spent += secondPass(round);
    ends->steps += spent;
    if (polishFailed()) sortOut();
    collect(ends);
  }

 private:
  static constexpr TrackingOptions kFirstPass{2.5e-2, 0.15, 1e-2, 0.08, 0.3, 1e-6, kMaxStepsFirstPass};
  static constexpr double kHopeless = 0.8;  // share of bad paths that only degenerate data have
  static constexpr double kHuge = 1e5;      // size of the unknowns or their reciprocals that counts as infinite
  // In single precision: the last Newton step, how close to real a solution is that may be real, and so on.
  static constexpr double kFloatConverged = 1e-4;
  static constexpr double kFloatReal = 3e-2;
  static constexpr double kFloatImproper = 1e-3;
  static constexpr double kFloatDistinct = 1e-2;
  // In double precision.
  static constexpr double kConverged = 1e-8;
  static constexpr double kReal = 1e-6;
  static constexpr double kImproper = 1e-7;
  static constexpr double kDistinct = 1e-6;
  // Where Newton's method converges slowly.
  static constexpr double kAlmostConverged = 1e-6;
  static constexpr double kAlmostImproper = 1e-5;
  static constexpr int kPolishSteps = 6;
  static constexpr int kManyPolishSteps = 30;

  using DoublePoint = Point<double, N>;
  using FirstTracker = PathTracker<System, Floats, Pivoting::None>;
  using SecondTracker = PathTracker<System, Doubles, Pivoting::Rows>;

  enum class State {
    Single,  // a solution, known to single precision and not real
    Double,  // a solution to double precision
    Bad,
    AtInfinity,  // bad, and not worth another round
  };

  bool isBad(int i) const { return state_[i] == State::Bad || state_[i] == State::AtInfinity; }
  int countOf(State state) const {
    int count = 0;
    for (int i = 0; i < paths_; ++i) count += state_[i] == state;
    return count;
  }

  // --- first pass

  void firstPass(PathEnd<float, N>* ends) {
    const typename System::template Homotopy<float> homotopy = Problem::singlePrecision(homotopy_);
    const Point<float, N>* starts = problem_.starts();
    Point<float, N> tangents[kMaxPaths], reached[kMaxPaths];
    int all[kMaxPaths] = {};
    float lastStep[kMaxPaths];
    for (int i = 0; i < paths_; ++i) all[i] = i;
    FirstTracker::startTangents(homotopy, starts, all, paths_, tangents);
    FirstTracker::track(homotopy, starts, tangents, all, paths_, kFirstPass, ends);
    for (int i = 0; i < paths_; ++i) reached[i] = ends[i].point;
    newtonSteps<System, Floats, Pivoting::None>(homotopy, 1, reached, all, paths_, 1, 0.0f, lastStep);
    for (int i = 0; i < paths_; ++i) {
      point_[i] = widened(reached[i]);
      state_[i] = ends[i].reached ? State::Single : State::Bad;
      lastStep_[i] = 1;
      doubtful_[i] = !(lastStep[i] < kFloatConverged);
    }
  }

  static DoublePoint widened(const Point<float, N>& point) {
    DoublePoint result;
    for (int k = 0; k < N; ++k) {
      result.re[k] = point.re[k];
      result.im[k] = point.im[k];
    }
    return result;
  }

  // --- judging end points

  // Where the data move solutions to infinity, single precision follows their paths far enough. Huge unknowns alone are no proof.
  void giveUpInfinitePaths() {
    if (!problem_.hasInfiniteSolutions()) return;
    for (int i = 0; i < paths_; ++i)
      if (state_[i] == State::Bad && isHuge(i)) state_[i] = State::AtInfinity;
  }
  bool isHuge(int i) const {
    bool huge = false;
    for (int k = 0; k < N; ++k) {
      const double size = squaredNorm(component(point_[i], k));
      huge = huge || size > kHuge * kHuge || (k >= System::kAbsolute && size * kHuge * kHuge < 1);
    }
    return huge;
  }

  // Whether the end points differ by less than the tolerance, relative to their size.
  bool coincide(int i, int j, double tolerance) const {
    for (int k = 0; k < N; ++k) {
      const Complex<double> a = component(point_[i], k), b = component(point_[j], k);
      if (squaredNorm(a - b) > tolerance * tolerance * (1 + squaredNorm(a))) return false;
    }
    return true;
  }
  bool isNearAnother(int i) const {
    for (int j = 0; j < paths_; ++j)
      if (j != i && !isBad(j) && coincide(i, j, kFloatDistinct)) return true;
    return false;
  }

  void polish(const int* indices, int count, int steps = kPolishSteps) {
    newtonSteps<System, Doubles, Pivoting::Rows>(homotopy_, 1, point_, indices, count, steps, kConverged, lastStep_);
    for (int i = 0; i < count; ++i) state_[indices[i]] = lastStep_[indices[i]] < kConverged ? State::Double : State::Bad;
  }
  template <class Condition>
  void polishSinglesIf(Condition condition) {
    int chosen[kMaxPaths] = {}, count = 0;
    for (int i = 0; i < paths_; ++i)
      if (state_[i] == State::Single && condition(i)) chosen[count++] = i;
    polish(chosen, count);
  }

  // Polishes what single precision cannot decide and finds what is bad. A doubtful end may move to another one.
  void sortOut() {
    polishSinglesIf([this](int i) { return isUndecided(i); });
    polishSinglesIf([this](int i) { return isNearAnother(i); });
    for (int i = 0; i < paths_; ++i)
      if (state_[i] == State::Double && problem_.isImproper(point_[i], kImproper)) state_[i] = State::Bad;
    findTwins();
    for (int i = 0; i < paths_; ++i)
      if (twin_[i]) state_[i] = State::Bad;
  }
  bool isUndecided(int i) const {
    return doubtful_[i] || problem_.isImproper(point_[i], kFloatImproper) ||
           (problem_.isReal(point_[i], kFloatReal) && problem_.isUseful(point_[i]));
  }
  void findTwins() {
    for (int i = 0; i < paths_; ++i) twin_[i] = false;
    for (int i = 0; i < paths_; ++i)
      for (int j = 0; j < i; ++j)
        if (state_[i] == State::Double && state_[j] == State::Double && coincide(i, j, kDistinct)) {
          twin_[i] = true;
          twin_[j] = true;
        }
  }

  // --- second pass

  // Returns the number of steps.
  int secondPass(int round) {
    int bad[kMaxPaths] = {}, count = 0;
    for (int i = 0; i < paths_; ++i)
      if (state_[i] == State::Bad) bad[count++] = i;
    PathEnd<double, N> ends[kMaxPaths];
    trackAgain(bad, count, carefulOptions(round, count), ends);
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

  static TrackingOptions carefulOptions(int round, int paths) {
    constexpr double kTolerances[] = {4e-3, 4e-4, 4e-5};
    const double tolerance = kTolerances[round < 2 ? round : 2];
    const int share = kMaxStepsPerRound / paths;
    TrackingOptions options;
    options.tolerance = tolerance;
    options.acceptFirst = 5 * tolerance;
    options.acceptSecond = 0.05 * tolerance;
    options.firstStep = 0.02;
    options.largestStep = 0.2;
    options.smallestStep = 1e-12;
    options.attempts = share < kMaxStepsSecondPass ? share : kMaxStepsSecondPass;
    return options;
  }

  // Tracks the given paths in double precision, the i-th to ends[i].
  void trackAgain(const int* paths, int count, const TrackingOptions& options, PathEnd<double, N>* ends) const {
    DoublePoint starts[kMaxPaths], tangents[kMaxPaths];
    double lastStep[kMaxPaths];
    int all[kMaxPaths] = {};
    for (int i = 0; i < count; ++i) {
      all[i] = i;
      starts[i] = widened(problem_.starts()[paths[i]]);
    }
    newtonSteps<System, Doubles, Pivoting::Rows>(homotopy_, 0, starts, all, count, kPolishSteps, kConverged, lastStep);
    SecondTracker::startTangents(homotopy_, starts, all, count, tangents);
    SecondTracker::track(homotopy_, starts, tangents, all, count, options, ends);
  }

  // --- result

  // A path to a solution that is almost double may fail shortly before its end, but close enough for Newton's method, which takes
  // many steps there. Returns whether there are such paths.
  bool polishFailed() {
    int finite[kMaxPaths] = {}, count = 0;
    for (int i = 0; i < paths_; ++i) {
      const bool slow = state_[i] == State::Bad && !(lastStep_[i] < kConverged);
      if (slow || (state_[i] == State::AtInfinity && !isHuge(i))) finite[count++] = i;
    }
    polish(finite, count, kManyPolishSteps);
    return count > 0;
  }

  void collect(EndPoints* ends) {
    for (int i = 0; i < paths_; ++i) keepOneTwin(i);
    bool known[kMaxPaths] = {};
    for (int i = 0; i < paths_; ++i) {
      ends->accepted += !isBad(i);
      known[i] = state_[i] == State::Double || (isAlmostConverged(i) && !repeatsKnown(i, known));
      if (known[i] && problem_.isReal(point_[i], kReal) && problem_.isUseful(point_[i])) ends->point[ends->count++] = point_[i];
    }
  }

  // Of paths that ended on the same solution, the first counts.
  void keepOneTwin(int i) {
    if (!twin_[i]) return;
    for (int j = 0; j < i; ++j)
      if (twin_[j] && coincide(i, j, kDistinct)) return;
    state_[i] = State::Double;
  }

  // Newton's method converges slowly, and not fully, to a solution that is almost double: of the pair, one is good enough. But so
  // it does to an improper solution where that is a multiple one.
  bool isAlmostConverged(int i) const {
    return state_[i] == State::Bad && !(lastStep_[i] < kConverged) && lastStep_[i] < kAlmostConverged &&
           !problem_.isImproper(point_[i], kAlmostImproper);
  }
  bool repeatsKnown(int i, const bool* known) const {
    for (int j = 0; j < i; ++j)
      if (known[j] && coincide(i, j, kAlmostConverged)) return true;
    return false;
  }

  const Problem problem_;
  const typename System::template Homotopy<double> homotopy_;
  const int paths_;
  DoublePoint point_[kMaxPaths];
  double lastStep_[kMaxPaths];  // of the last polish
  State state_[kMaxPaths];
  bool doubtful_[kMaxPaths];
  bool twin_[kMaxPaths] = {};  // whether sortOut found another path on the same end
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv
