#include "solvers/MinimalProblems.hpp"

#include "CheckArguments.hpp"

namespace hybridgv {
namespace solvers {

// The number of rays of the camera that has most.
static int mostOfOneCamera(const RayMatch* rays, int count) {
  int most = 0;
  for (int i = 0; i < count; ++i) {
    const auto isOfSame = [&](const RayMatch& ray) { return ray.camera == rays[i].camera; };
    most = std::max(most, static_cast<int>(std::count_if(rays, rays + count, isOfSame)));
  }
  return most;
}

// Image coordinates in units of the focal length.
template <class Match>
static Match ofFocalLengthOne(Match match, double focalLength) {
  match.u /= focalLength;
  match.v /= focalLength;
  return match;
}

int solve(const MinimalSolver& solver, const RayMatch* rays, const PointMatch* points, double focalLength, FocalPose* solutions) {
  if (solver.intrinsics.focalLength) return solver.solve(rays, points, solutions);
  if (!(focalLength > 0)) return 0;
  RayMatch scaledRays[kMaxSampleSize];
  PointMatch scaledPoints[kMaxSampleSize];
  for (int i = 0; i < solver.rays; ++i) scaledRays[i] = ofFocalLengthOne(rays[i], focalLength);
  for (int i = 0; i < solver.points; ++i) scaledPoints[i] = ofFocalLengthOne(points[i], focalLength);
  const int count = solver.solve(scaledRays, scaledPoints, solutions);
  for (int i = 0; i < count; ++i) solutions[i].focalLength = focalLength;
  return count;
}

void solveMany(const MinimalSolver& solver, PointMatch* points, const double* focalLengths, int samples, FocalPose* solutions,
               int* found) {
  for (int i = 0; i < samples; ++i)
    for (PointMatch* point = points + i * solver.points; point != points + (i + 1) * solver.points; ++point)
      *point = ofFocalLengthOne(*point, focalLengths[i]);
  solver.solveMany(points, samples, solutions, found);
  for (int i = 0; i < samples; ++i)
    for (int k = 0; k < found[i]; ++k) solutions[i * solver.maxSolutions + k].focalLength = focalLengths[i];
}

bool canGive(const MinimalSolver& solver, const RayMatch* rays) {
  if (solver.draw == RayDraw::OneCamera)
    return std::all_of(rays, rays + solver.rays, [rays](const RayMatch& ray) { return ray.camera == rays[0].camera; });
  if (solver.draw == RayDraw::AllButOne) return mostOfOneCamera(rays, solver.rays) == solver.rays - 1;
  return true;
}

const MinimalSolver* SolverRows::forSample(const RayMatch* rays) const {
  const auto found = std::find_if(begin_, end_, [rays](const MinimalSolver& solver) { return canGive(solver, rays); });
  return found == end_ ? nullptr : found;
}

SolverRows rowsOf(Solver id) {
  for (const MinimalSolver& solver : kMinimalSolvers)
    if (solver.id == id) return rowsOf(solver.name);
  throwInvalid("solver", "no such value: " + std::to_string(static_cast<int>(id)));
}

std::vector<SolverRows> minimalProblems() {
  std::vector<SolverRows> result;
  for (const MinimalSolver* row = std::begin(kMinimalSolvers); row != std::end(kMinimalSolvers); row = result.back().end())
    result.push_back(rowsOf(row->name));
  return result;
}

void throwUnknownProblem(std::string_view name) {
  std::string valid;
  for (const SolverRows& problem : minimalProblems()) valid += std::string(valid.empty() ? "" : ", ") + problem.name();
  throwInvalid("solver", "unknown name \"" + std::string(name) + "\", valid are " + valid);
}

}  // namespace solvers
}  // namespace hybridgv
