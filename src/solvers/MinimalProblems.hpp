// The table of minimal problems: the only place where the facts of a solver stand.
//
// A new solver is a file in this folder, its declaration and its row here, an enumerator of Solver and a public function. What
// walks over the table then knows it: names, hybridRansac, the problems for OpenGV's loops, tests, fuzzers and benchmarks.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace solvers {

namespace three_points {
int p4pf(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
int p35pf(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
int h13f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace three_points

namespace one_centre {
// All five rays from one centre.
int h51f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Six rays from one centre, no point; the position is returned at distance 1 from that centre.
int sixptOnefocal(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Six rays from one centre, the last from another.
int h70f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace one_centre

namespace h32f {
// Any pattern of shared centres.
int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace h32f

namespace h51f {
// Any pattern of shared centres; recognizes it from RayMatch::camera.
int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace h51f

namespace h70f {
// Any pattern of shared centres; recognizes it from RayMatch::camera. All seven rays from one centre: nothing.
int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace h70f

namespace known_focal {
int p3p(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
void p3pMany(const PointMatch* points, int samples, FocalPose* solutions, int* found);
// Rays of one camera or of two.
int h22(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// All rays from one centre.
int h41(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Five rays from one centre; the position is returned at distance 1 from it.
int fivept(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Five rays from one centre, one from another.
int h60(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace known_focal

constexpr correspondences::Intrinsics kUnknownFocalLength = {true, false}, kKnownFocalLength = {false, false};

// A row per way to draw and solve. The rows of one problem, which have one name, stand together; of several the first is taken
// whose draw can give the sample at hand.
// clang-format off
inline constexpr MinimalSolver kMinimalSolvers[] = {
    // id, name, rays, points, draw, most solutions, cost, prior, exact coordinates, follows paths, intrinsics, functions
    {Solver::P4Pf,  "p4pf",           0, 4, RayDraw::Uniform,    6, 1.4, 0.1, 6, false, kUnknownFocalLength, &three_points::p4pf},
    {Solver::P35Pf, "p35pf",          0, 4, RayDraw::Uniform,   10, 2.0, 0.1, 7, false, kUnknownFocalLength, &three_points::p35pf},
    {Solver::H13f,  "h13f",           1, 3, RayDraw::Uniform,   12, 2.7, 1,   6, false, kUnknownFocalLength, &three_points::h13f},
    {Solver::H32f,  "h32f",           3, 2, RayDraw::Uniform,   26, 8,   1,   4, false, kUnknownFocalLength, &h32f::solve},
    {Solver::H51f,  "h51f",           5, 1, RayDraw::OneCamera,  9, 2.6, 1,   2, false, kUnknownFocalLength, &one_centre::h51f},
    {Solver::H51f,  "h51f",           5, 1, RayDraw::Spread,    56, 220, 1,   2, true,  kUnknownFocalLength, &h51f::solve},
    {std::nullopt,  "sixpt_onefocal", 6, 0, RayDraw::OneCamera,  9, 2.6, 0,   0, false, kUnknownFocalLength, &one_centre::sixptOnefocal},
    {Solver::H70f,  "h70f",           7, 0, RayDraw::AllButOne,  9, 4,   1,   0, false, kUnknownFocalLength, &h70f::solve},
    {Solver::H70f,  "h70f",           7, 0, RayDraw::Spread,   118, 850, 1,   0, true,  kUnknownFocalLength, &h70f::solve},
    {Solver::P3P,   "p3p",            0, 3, RayDraw::Uniform,    4, 0.15, 1,  6, false, kKnownFocalLength,   &known_focal::p3p, &known_focal::p3pMany},
    {Solver::H22,   "h22",            2, 2, RayDraw::Uniform,   16, 2.0, 0.5, 4, false, kKnownFocalLength,   &known_focal::h22},
    {Solver::H41,   "h41",            4, 1, RayDraw::OneCamera, 10, 4.0, 0.2, 2, false, kKnownFocalLength,   &known_focal::h41},
    {Solver::H60,   "h60",            6, 0, RayDraw::AllButOne, 10, 4.0, 0.2, 0, false, kKnownFocalLength,   &known_focal::h60},
    {std::nullopt,  "fivept",         5, 0, RayDraw::OneCamera, 10, 4.0, 0,   0, false, kKnownFocalLength,   &known_focal::fivept},
};
// clang-format on

// The largest value of a column.
constexpr int largest(int MinimalSolver::*column) {
  int result = 0;
  for (const MinimalSolver& solver : kMinimalSolvers) result = std::max(result, solver.*column);
  return result;
}
constexpr int kMaxSolutions = largest(&MinimalSolver::maxSolutions);
// Of samples side by side.
constexpr int mostSolutionsSideBySide() {
  int result = 0;
  for (const MinimalSolver& solver : kMinimalSolvers)
    if (solver.solveMany != nullptr) result = std::max(result, kSideBySide * solver.maxSolutions);
  return result;
}
static_assert(mostSolutionsSideBySide() <= kMaxSolutions, "there is room for them where there is for those of one sample");
// Correspondences of one kind in a sample.
constexpr int kMaxSampleSize = std::max(largest(&MinimalSolver::rays), largest(&MinimalSolver::points));

// The solutions of a sample of a camera with this focal length. Solvers that estimate it do not use it; the others find nothing for
// one that is not positive.
int solve(const MinimalSolver& solver, const RayMatch* rays, const PointMatch* points, double focalLength, FocalPose* solutions);

// The same for samples side by side (SolveManyFunction), each with a focal length of its own.
void solveMany(const MinimalSolver& solver, PointMatch* points, const double* focalLengths, int samples, FocalPose* solutions,
               int* found);

// Whether this way to draw can give these rays of a sample.
bool canGive(const MinimalSolver& solver, const RayMatch* rays);

// The rows of one problem.
class SolverRows {
 public:
  constexpr SolverRows(const MinimalSolver* begin, const MinimalSolver* end) : begin_(begin), end_(end) {}

  constexpr const MinimalSolver* begin() const { return begin_; }
  constexpr const MinimalSolver* end() const { return end_; }

  // What all rows have in common.
  constexpr const std::optional<Solver>& id() const { return begin_->id; }
  constexpr const char* name() const { return begin_->name; }
  constexpr int rays() const { return begin_->rays; }
  constexpr int points() const { return begin_->points; }

  // The row for a sample, nullptr if there is none.
  const MinimalSolver* forSample(const RayMatch* rays) const;

 private:
  const MinimalSolver *begin_, *end_;
};

[[noreturn]] void throwUnknownProblem(std::string_view name);

// The rows of a name. A name that does not exist is std::invalid_argument, or a compiler's error in a constant.
constexpr SolverRows rowsOf(std::string_view name) {
  const MinimalSolver* begin = std::begin(kMinimalSolvers);
  while (begin != std::end(kMinimalSolvers) && name != begin->name) ++begin;
  if (begin == std::end(kMinimalSolvers)) throwUnknownProblem(name);
  const MinimalSolver* end = begin;
  while (end != std::end(kMinimalSolvers) && name == end->name) ++end;
  return {begin, end};
}

// The rows of an enumerator; std::invalid_argument if it is none.
SolverRows rowsOf(Solver id);

// Every problem once, in the table's order.
std::vector<SolverRows> minimalProblems();

}  // namespace solvers
}  // namespace hybridgv
