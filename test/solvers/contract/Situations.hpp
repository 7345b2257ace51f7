// Minimal problems that are degenerate or extreme, made from a scene in general position by one change.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "SolverCases.hpp"

namespace hybridgv {
namespace test {

// Where everything is. The rays' scene points come first, then the 3D points.
struct SituationScene {
  FocalPose query;
  std::vector<Eigen::Vector3d> scenePoints;
  std::vector<Eigen::Vector3d> centres;  // one per rig camera
  std::vector<int> cameras;              // of the rays

  SituationScene(Random& random, const SolverCase& solver)
      : query(cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000))) {
    for (std::size_t k = 0; k < solver.raysPerCamera.size(); ++k) {
      centres.push_back(random.uniform(15, 25) * random.direction());
      cameras.insert(cameras.end(), static_cast<std::size_t>(solver.raysPerCamera[k]), static_cast<int>(k));
    }
    for (std::size_t i = 0; i < cameras.size() + static_cast<std::size_t>(solver.points); ++i) {
      Eigen::Vector3d point = random.vector(-5, 5);
      while (!isVisible(query, point)) point = random.vector(-5, 5);
      scenePoints.push_back(point);
    }
  }

  std::size_t rays() const { return cameras.size(); }
  std::size_t points() const { return scenePoints.size() - rays(); }
  Eigen::Vector3d& point(std::size_t i) { return scenePoints[rays() + i]; }
  Eigen::Vector3d& centreOfRay(std::size_t i) { return centres[static_cast<std::size_t>(cameras[i])]; }

  MinimalProblem problem() const {
    MinimalProblem problem;
    problem.truth = query;
    for (std::size_t i = 0; i < scenePoints.size(); ++i)
      if (i < rays())
        problem.rays.push_back(makeRayMatch(query, scenePoints[i], centres[static_cast<std::size_t>(cameras[i])], cameras[i]));
      else
        problem.points.push_back(makePointMatch(query, scenePoints[i]));
    return problem;
  }
};

// Changes of the scene come before the projection, changes of the problem after it.
struct Situation {
  std::string name;
  // What comes of it, a letter for each of solverCases():
  //   t  the true pose is among the solutions
  //   0  there are no solutions
  //   v  what is returned, if anything, satisfies the equations
  //   .  the situation needs correspondences that the solver does not take
  std::string outcomes;
  std::function<void(SituationScene&, Random&)> changeScene;
  std::function<void(MinimalProblem&, Random&)> changeProblem;
};

inline std::ostream& operator<<(std::ostream& stream, const Situation& situation) { return stream << situation.name; }

const std::vector<Situation>& situations();

}  // namespace test
}  // namespace hybridgv
