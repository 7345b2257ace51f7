// The path solver on systems made for the purpose: of one unknown each, with ends that Newton's method reaches slowly.
#include "math/homotopy/PathSolver.hpp"

#include <gtest/gtest.h>

#include <ctime>

namespace hybridgv {
namespace test {
namespace {

using namespace math;

// Paths that stay where they start, at (k + 1) / 64 for path k: the only equation is satisfied everywhere. But below a limit
// Newton's steps are 1e-7 for ever, as near a double solution, where they become neither larger than 1e-6 nor smaller than 1e-8.
struct StandingSystem {
  static constexpr int kUnknowns = 1, kAbsolute = 1;

  template <class Scalar>
  struct Homotopy {
    Scalar slowBelow;
  };
  template <class V>
  struct Data {};
  template <class V>
  static void dataAt(const Homotopy<Real<V>>&, V, Data<V>&) {}

  template <bool derivative, class V>
  static void evaluate(const Homotopy<Real<V>>& homotopy, V, const Data<V>&, const Complex<V> (&x)[kUnknowns],
                       Complex<V> (&rows)[kUnknowns][kUnknowns + 1 + derivative]) {
    const V zero{}, slow = broadcast<V>(Real<V>(1e-7));
    rows[0][0] = {zero + 1, zero};
    rows[0][1] = {select(x[0].re < homotopy.slowBelow, slow, zero), zero};
    if constexpr (derivative) rows[0][2] = {zero, zero};
  }
};

class StandingPaths {
 public:
  using System = StandingSystem;
  using Solution = Point<double, 1>;
  static constexpr int kMaxPaths = 60;

  // The first `slow` paths converge slowly. What is not beyond `improper` is an improper solution.
  StandingPaths(int slow, double improper) : slow_(slow), improper_(improper) {
    for (int k = 0; k < kMaxPaths; ++k) starts_[k] = {{static_cast<float>(positionOf(k))}, {0}};
  }
  static double positionOf(int path) { return (path + 1) / 64.0; }

  int paths() const { return kMaxPaths; }
  const Point<float, 1>* starts() const { return starts_; }
  System::Homotopy<double> homotopy() const { return {positionOf(slow_) - 0.5 / 64}; }
  static System::Homotopy<float> singlePrecision(const System::Homotopy<double>& from) {
    return {static_cast<float>(from.slowBelow)};
  }
  bool hasInfiniteSolutions() const { return false; }
  bool isReal(const Solution&, double) const { return true; }
  bool isImproper(const Solution& x, double tolerance) const { return x.re[0] < improper_ + tolerance; }
  bool isUseful(const Solution&) const { return true; }

 private:
  int slow_;
  double improper_;
  Point<float, 1> starts_[kMaxPaths];
};

using Solver = PathSolver<StandingPaths>;

TEST(PathSolver, AcceptsAllEndsOfAnEasySystem) {
  Solver::EndPoints ends;
  Solver(StandingPaths(0, -1)).solve(&ends);
  EXPECT_TRUE(ends.complete());
  EXPECT_EQ(ends.paths, StandingPaths::kMaxPaths);
  ASSERT_EQ(ends.count, StandingPaths::kMaxPaths);
  for (int i = 0; i < ends.count; ++i) EXPECT_EQ(ends.point[i].re[0], StandingPaths::positionOf(i));
}

// Of ends that are almost converged each is asked whether it repeats an earlier one, and these whether they do.
TEST(PathSolver, TakesNoLongerForManyEndsThatConvergeSlowly) {
  constexpr int kSlow = 32;
  Solver::EndPoints ends;
  const std::clock_t start = std::clock();
  Solver(StandingPaths(kSlow, -1)).solve(&ends);
  EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC) << "one second of processor time";
  EXPECT_EQ(ends.accepted, StandingPaths::kMaxPaths - kSlow);
  EXPECT_EQ(ends.count, StandingPaths::kMaxPaths) << "an end that is almost converged is as good as one";
}

TEST(PathSolver, ReturnsNoImproperEndThatConvergesSlowly) {
  constexpr int kSlow = 8, kImproper = 5;
  const double improper = StandingPaths::positionOf(kImproper - 1) - 5e-6;
  Solver::EndPoints ends;
  Solver(StandingPaths(kSlow, improper)).solve(&ends);
  EXPECT_EQ(ends.accepted, StandingPaths::kMaxPaths - kSlow);
  EXPECT_EQ(ends.count, StandingPaths::kMaxPaths - kImproper);
  for (int i = 0; i < ends.count; ++i) EXPECT_GT(ends.point[i].re[0], improper + 1e-2);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv
