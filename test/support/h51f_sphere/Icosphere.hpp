// Directions spread evenly over the sphere: the faces of an icosahedron, each divided into frequency^2 triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

namespace hybridgv {
namespace test {

struct Icosphere {
  std::vector<Eigen::Vector3f> directions;
  std::vector<std::array<int, 3>> triangles;  // indices of directions
  float edge = 0;                             // mean length of a triangle's edge
};

inline Icosphere makeIcosphere(int frequency) {
  // Corners: cyclic permutations of (0, +-1, +-golden). Two of them share an edge if they are 2 apart.
  const float golden = (1 + std::sqrt(5.0f)) / 2;
  std::vector<Eigen::Vector3f> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (float one : {-1.0f, 1.0f})
      for (float other : {-golden, golden}) {
        Eigen::Vector3f corner = Eigen::Vector3f::Zero();
        corner[(axis + 1) % 3] = one;
        corner[(axis + 2) % 3] = other;
        corners.push_back(corner);
      }
  const auto adjacent = [&](std::size_t a, std::size_t b) { return (corners[a] - corners[b]).norm() < 2.1f; };
  Icosphere sphere;
  sphere.edge = 1.1f / static_cast<float>(frequency);
  const auto addFace = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    const int first = static_cast<int>(sphere.directions.size());
    const auto index = [&](int row, int column) { return first + row * (row + 1) / 2 + column; };
    for (int row = 0; row <= frequency; ++row)
      for (int column = 0; column <= row; ++column) {
        const auto n = static_cast<float>(frequency), i = static_cast<float>(row), j = static_cast<float>(column);
        sphere.directions.push_back(((n - i) * a + (i - j) * b + j * c).normalized());
        if (row == frequency) continue;
        sphere.triangles.push_back({index(row, column), index(row + 1, column), index(row + 1, column + 1)});
        if (column < row) sphere.triangles.push_back({index(row, column), index(row + 1, column + 1), index(row, column + 1)});
      }
  };
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t c = 0; c < b; ++c)
        if (adjacent(a, b) && adjacent(b, c) && adjacent(c, a)) addFace(corners[a], corners[b], corners[c]);
  return sphere;
}

}  // namespace test
}  // namespace hybridgv
