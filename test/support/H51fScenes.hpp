// Scenes for H51f: which rays share a centre, and where everything is.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace test {

using RaysPerCamera = std::vector<int>;

inline const std::vector<RaysPerCamera>& h51fPatterns() {
  static const std::vector<RaysPerCamera> patterns = {{1, 1, 1, 1, 1}, {2, 1, 1, 1}, {2, 2, 1}, {3, 1, 1}, {3, 2}, {4, 1}};
  return patterns;
}

// "2111"
inline std::string nameOf(const RaysPerCamera& pattern) {
  std::string name;
  for (int count : pattern) name += std::to_string(count);
  return name;
}

template <class RandomCentre, class RandomPoint>
MinimalProblem makeH51fProblem(const FocalPose& query, const RaysPerCamera& pattern, RandomCentre randomCentre,
                               RandomPoint randomPoint, int points = 1) {
  MinimalProblem problem;
  problem.truth = query;
  int camera = 0;
  for (int count : pattern) {
    const Eigen::Vector3d centre = randomCentre();
    for (int i = 0; i < count; ++i) problem.rays.push_back(makeRayMatch(query, randomPoint(), centre, camera));
    ++camera;
  }
  for (int i = 0; i < points; ++i) problem.points.push_back(makePointMatch(query, randomPoint()));
  return problem;
}

// Rig cameras within +-halfSize on each axis, the query among them, points at depth 5 .. 15: a small baseline against the scene.
inline MinimalProblem makeRigProblem(Random& random, const RaysPerCamera& pattern, double halfSize, int points = 1) {
  FocalPose query;
  query.rotation = random.rotation();
  query.focalLength = random.uniform(500, 2000);
  query.position = random.vector(-halfSize, halfSize);
  const auto centre = [&] { return random.vector(-halfSize, halfSize); };
  const auto point = [&]() -> Eigen::Vector3d {
    const double u = random.uniform(-500, 500), v = random.uniform(-500, 500), depth = random.uniform(5, 15);
    return query.position + depth * (query.rotation * Eigen::Vector3d(u / query.focalLength, v / query.focalLength, 1));
  };
  return makeH51fProblem(query, pattern, centre, point, points);
}

// All cameras on the query's side of the scene, as in structure from motion.
inline MinimalProblem makeSameSideProblem(Random& random, const RaysPerCamera& pattern, int points = 1) {
  const FocalPose query = cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000));
  const auto centre = [&]() -> Eigen::Vector3d {
    Eigen::Vector3d direction = random.direction();
    while (direction.dot(query.position.normalized()) < 0.7) direction = random.direction();
    return random.uniform(15, 25) * direction;
  };
  const auto point = [&] {
    Eigen::Vector3d result = random.vector(-5, 5);
    while (!isVisible(query, result)) result = random.vector(-5, 5);
    return result;
  };
  return makeH51fProblem(query, pattern, centre, point, points);
}

// All points in one plane.
inline MinimalProblem makePlanarProblem(Random& random, const RaysPerCamera& pattern, int points = 1) {
  const FocalPose query = cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000));
  const Eigen::Vector3d normal = random.direction();
  const auto centre = [&]() -> Eigen::Vector3d { return random.uniform(15, 25) * random.direction(); };
  const auto point = [&] {
    Eigen::Vector3d result;
    do {
      result = random.vector(-5, 5);
      result -= normal * normal.dot(result);
    } while (!isVisible(query, result));
    return result;
  };
  return makeH51fProblem(query, pattern, centre, point, points);
}

// Replaces the 3D point, or the scene point of a ray, by one that is seen exactly at the principal point.
inline void movePointToAxis(MinimalProblem& problem, double depth) {
  problem.points[0] = {0, 0, problem.truth.position + depth * problem.truth.rotation.col(2)};
}
inline void moveRayToAxis(MinimalProblem& problem, std::size_t ray, double depth) {
  const Eigen::Vector3d point = problem.truth.position + depth * problem.truth.rotation.col(2);
  problem.rays[ray].u = problem.rays[ray].v = 0;
  problem.rays[ray].direction = (point - problem.rays[ray].centre).normalized();
}

// Scenes other than the usual one.
struct MinimalScene {
  std::string name;
  std::function<MinimalProblem(Random&, const RaysPerCamera&)> make;
  bool finite = true;  // no solutions at infinity
};
inline const std::vector<MinimalScene>& h51fScenes() {
  static const std::vector<MinimalScene> scenes = {
      {"rig +-0.5", [](Random& random, const RaysPerCamera& pattern) { return makeRigProblem(random, pattern, 0.5); }},
      {"rig +-0.1", [](Random& random, const RaysPerCamera& pattern) { return makeRigProblem(random, pattern, 0.1); }},
      {"same side", [](Random& random, const RaysPerCamera& pattern) { return makeSameSideProblem(random, pattern); }},
      {"planar", [](Random& random, const RaysPerCamera& pattern) { return makePlanarProblem(random, pattern); }},
      {"point at the principal point",
       [](Random& random, const RaysPerCamera& pattern) {
         MinimalProblem problem = makeMinimalProblem(random, pattern, 1);
         movePointToAxis(problem, random.uniform(10, 30));
         return problem;
       },
       false},
      {"ray at the principal point",
       [](Random& random, const RaysPerCamera& pattern) {
         MinimalProblem problem = makeMinimalProblem(random, pattern, 1);
         moveRayToAxis(problem, 1, random.uniform(10, 30));
         return problem;
       },
       false},
  };
  return scenes;
}

}  // namespace test
}  // namespace hybridgv
