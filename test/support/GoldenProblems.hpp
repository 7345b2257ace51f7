// Reader of the recorded minimal problems, each with all its real solutions that have positive depths.
//
//     problem ID
//     p2 u v  cx cy cz  qx qy qz            2D-2D: image point; ray centre and unit direction in the rig's frame
//     p3 u v  X Y Z                         2D-3D: image point; point in the rig's frame
//     solution f  R11 R12 .. R33  x y z     focal length, rotation query -> rig (row-major), position of the query
#pragma once

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace test {

struct GoldenProblem {
  MinimalProblem problem;  // without a truth
  FocalPoses solutions;
};

// Rays with equal centres get the same camera number.
inline int cameraOf(const MinimalProblem& problem, const Eigen::Vector3d& centre) {
  int cameras = 0;
  for (const solvers::RayMatch& ray : problem.rays) {
    if (ray.centre == centre) return ray.camera;
    cameras = std::max(cameras, ray.camera + 1);
  }
  return cameras;
}

// The problems of one file of the folder, by default the golden one; empty if the file is absent.
inline std::vector<GoldenProblem> readGoldenProblems(const std::string& name, const std::string& folder = HYBRIDGV_GOLDEN_DIR) {
  std::ifstream file(folder + "/" + name);
  std::vector<GoldenProblem> problems;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "problem") {
      problems.emplace_back();
    } else if (key == "p2") {
      solvers::RayMatch ray{};
      words >> ray.u >> ray.v;
      for (int i = 0; i < 3; ++i) words >> ray.centre[i];
      for (int i = 0; i < 3; ++i) words >> ray.direction[i];
      ray.direction.normalize();
      ray.camera = cameraOf(problems.back().problem, ray.centre);
      problems.back().problem.rays.push_back(ray);
    } else if (key == "p3") {
      solvers::PointMatch match{};
      words >> match.u >> match.v;
      for (int i = 0; i < 3; ++i) words >> match.point[i];
      problems.back().problem.points.push_back(match);
    } else if (key == "solution") {
      FocalPose pose;
      words >> pose.focalLength;
      for (int i = 0; i < 9; ++i) words >> pose.rotation(i / 3, i % 3);
      for (int i = 0; i < 3; ++i) words >> pose.position[i];
      problems.back().solutions.push_back(pose);
    }
  }
  return problems;
}

}  // namespace test
}  // namespace hybridgv
