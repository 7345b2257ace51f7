#include "start_systems/Recording.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace hybridgv {
namespace test {
namespace {

constexpr double kImageScale = 500;

void print(const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) std::printf(" %.17g", vector[i]);
}

void print(const FocalPose& pose) {
  std::printf("solution %.17g", pose.focalLength);
  for (int i = 0; i < 9; ++i) std::printf(" %.17g", pose.rotation(i / 3, i % 3));
  print(pose.position);
  std::printf("\n");
}

}  // namespace

FocalPoses realPoses(const PathEnds& ends, const solvers::complex_rays::Frame& frame) {
  FocalPoses poses;
  for (const auto& end : ends) {
    if (!H70fFamily::PathProblem::isReal(end, 1e-8)) continue;
    const auto number = [&end](int k) { return std::complex<double>(end.re[k], end.im[k]); };
    poses.push_back(solvers::h70f::poseOf({number(0), number(1), number(2), number(3), number(4), number(5), number(6)}, frame));
  }
  return poses;
}

bool isSolution(const FocalPose& pose, const MinimalProblem& problem) {
  constexpr double kLargestResidual = 1e-7 * kImageScale;
  const auto meetsRay = [&pose](const solvers::RayMatch& ray) { return solvers::complex_rays::agrees(pose, ray, kImageScale); };
  const auto meetsPoint = [&pose](const solvers::PointMatch& match) { return pointResidual(pose, match) < kLargestResidual; };
  return std::all_of(problem.rays.begin(), problem.rays.end(), meetsRay) &&
         std::all_of(problem.points.begin(), problem.points.end(), meetsPoint);
}

FocalPoses solutionsAmong(const FocalPoses& poses, const MinimalProblem& problem) {
  FocalPoses solutions;
  std::copy_if(poses.begin(), poses.end(), std::back_inserter(solutions),
               [&problem](const FocalPose& pose) { return isSolution(pose, problem); });
  return solutions;
}

void print(std::size_t id, const MinimalProblem& problem, const FocalPoses& solutions) {
  std::printf("problem %zu\n", id);
  for (const solvers::RayMatch& ray : problem.rays) {
    std::printf("p2 %.17g %.17g", ray.u, ray.v);
    print(ray.centre);
    print(ray.direction);
    std::printf("\n");
  }
  for (const solvers::PointMatch& match : problem.points) {
    std::printf("p3 %.17g %.17g", match.u, match.v);
    print(match.point);
    std::printf("\n");
  }
  for (const FocalPose& pose : solutions) print(pose);
}

}  // namespace test
}  // namespace hybridgv
