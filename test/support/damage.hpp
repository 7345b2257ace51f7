// Makes exact correspondences noisy and wrong.
#pragma once

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace test {

// Gaussian noise on the query's image points [px].
inline void addNoise(Random& random, double sigma, MinimalProblem& problem) {
  for (solvers::RayMatch& ray : problem.rays) {
    ray.u += sigma * random.normal();
    ray.v += sigma * random.normal();
  }
  for (solvers::PointMatch& match : problem.points) {
    match.u += sigma * random.normal();
    match.v += sigma * random.normal();
  }
}

// Every k-th correspondence of each kind gets a random image point.
inline void addOutliers(Random& random, std::size_t k, MinimalProblem& problem) {
  for (std::size_t i = 0; i < problem.rays.size(); i += k) {
    problem.rays[i].u = random.uniform(-500, 500);
    problem.rays[i].v = random.uniform(-500, 500);
  }
  for (std::size_t i = 0; i < problem.points.size(); i += k) {
    problem.points[i].u = random.uniform(-500, 500);
    problem.points[i].v = random.uniform(-500, 500);
  }
}

}  // namespace test
}  // namespace hybridgv
