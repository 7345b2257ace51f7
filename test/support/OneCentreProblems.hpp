// Random problems whose rays have one common centre (H51f [5] and six rays without a point), generic and awkward ones.
#pragma once

#include "MinimalProblem.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace test {

// Six correspondences: five rays and a point, or six rays. Both problems are served by the same scenes.
enum class OneCentreKind { FiveRaysOnePoint, SixRays };

class OneCentreScene {
 public:
  OneCentreScene(Random& random, OneCentreKind kind)
      : random_(random), kind_(kind), query_(cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000))) {
    centre_ = random.uniform(15, 25) * random.direction();
    for (int i = 0; i < 6; ++i) points_[i] = visible([&] { return random_.vector(-5, 5); });
  }

  // All points within a cube of this half side instead of 5.
  void shrink(double halfSide) {
    for (Eigen::Vector3d& point : points_) point = visible([&] { return random_.vector(-halfSide, halfSide); });
  }
  // The first `count` points within a plane, up to `thickness` times their spread.
  void flatten(int count, double thickness) {
    const Eigen::Vector3d normal = random_.direction();
    for (int i = 0; i < count; ++i)
      points_[i] = visible([&]() -> Eigen::Vector3d {
        const Eigen::Vector3d point = random_.vector(-5, 5);
        return point - (1 - thickness) * normal.dot(point) * normal;
      });
  }
  // Point i on the query's optical axis, up to `distance`.
  void moveToAxis(int i, double distance) {
    points_[i] = query_.position + random_.uniform(12, 28) * query_.rotation.col(2) + distance * random_.direction();
    onAxis_ = distance == 0 ? i : -1;
  }

  MinimalProblem problem() const {
    MinimalProblem problem;
    problem.truth = query_;
    for (int i = 0; i < 6; ++i) {
      if (i == 5 && kind_ == OneCentreKind::FiveRaysOnePoint)
        problem.points.push_back(makePointMatch(query_, points_[i]));
      else
        problem.rays.push_back(makeRayMatch(query_, points_[i], centre_, 0));
    }
    if (onAxis_ >= 0) {  // exactly, not up to rounding
      if (onAxis_ < static_cast<int>(problem.rays.size()))
        problem.rays[static_cast<std::size_t>(onAxis_)].u = problem.rays[static_cast<std::size_t>(onAxis_)].v = 0;
      else
        problem.points[0].u = problem.points[0].v = 0;
    }
    return problem;
  }

 private:
  template <class Generate>
  Eigen::Vector3d visible(const Generate& generate) const {
    Eigen::Vector3d point = generate();
    while (!isVisible(query_, point)) point = generate();
    return point;
  }

  Random& random_;
  OneCentreKind kind_;
  FocalPose query_;
  Eigen::Vector3d centre_;
  Eigen::Vector3d points_[6];
  int onAxis_ = -1;
};

// Well-posed cases that are hard on the solvers.
struct OneCentreAwkwardCase {
  const char* name;
  void (*change)(OneCentreScene& scene);
  int failuresAllowed;  // of 2000
};

inline const std::vector<OneCentreAwkwardCase>& oneCentreAwkwardCases() {
  static const std::vector<OneCentreAwkwardCase> cases = {
      {"last image point at the principal point", [](OneCentreScene& scene) { scene.moveToAxis(5, 0); }, 2},
      {"last image point near the principal point", [](OneCentreScene& scene) { scene.moveToAxis(5, 0.01); }, 3},
      {"third image point at the principal point", [](OneCentreScene& scene) { scene.moveToAxis(2, 0); }, 2},
      {"five coplanar points", [](OneCentreScene& scene) { scene.flatten(5, 0); }, 4},
      {"six points flattened to 0.1", [](OneCentreScene& scene) { scene.flatten(6, 0.1); }, 2},
      {"six points flattened to 0.01", [](OneCentreScene& scene) { scene.flatten(6, 0.01); }, 3},
      {"six points flattened to 0.001", [](OneCentreScene& scene) { scene.flatten(6, 0.001); }, 4},
      {"narrow field of view", [](OneCentreScene& scene) { scene.shrink(0.15); }, 3},
  };
  return cases;
}

inline MinimalProblem makeOneCentreProblem(Random& random, OneCentreKind kind, const OneCentreAwkwardCase& awkward) {
  OneCentreScene scene(random, kind);
  awkward.change(scene);
  return scene.problem();
}

inline FocalPoses solveOneCentre(const MinimalProblem& problem) {
  FocalPose solutions[solvers::kMaxSolutions];
  const auto solve = problem.points.empty() ? &solvers::one_centre::sixptOnefocal : &solvers::one_centre::h51f;
  const int count = solve(problem.rays.data(), problem.points.data(), solutions);
  return {solutions, solutions + count};
}

}  // namespace test
}  // namespace hybridgv
