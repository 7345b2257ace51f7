// A minimal sample as the bytes of a fuzzer's input: first one byte per ray, its rig camera, then doubles: u, v, centre and
// direction of every ray, u, v and coordinates of every point. Bytes that are missing count as zero. Rays of one camera take the
// centre of its first ray.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace fuzz {

constexpr std::size_t kRayDoubles = 8, kPointDoubles = 5;
constexpr int kCameras = 6;
constexpr double kFocalLength = 1000;  // of the query, for solvers that need it

struct Sample {
  std::vector<solvers::RayMatch> rays;
  std::vector<solvers::PointMatch> points;
};

inline std::size_t sampleBytes(std::size_t rays, std::size_t points) {
  return rays + sizeof(double) * (rays * kRayDoubles + points * kPointDoubles);
}

inline Sample decodeSample(const std::uint8_t* data, std::size_t size, std::size_t rays, std::size_t points) {
  std::vector<std::uint8_t> bytes(sampleBytes(rays, points));
  std::copy(data, data + std::min(size, bytes.size()), bytes.begin());
  std::vector<double> values(rays * kRayDoubles + points * kPointDoubles);
  std::memcpy(values.data(), bytes.data() + rays, sizeof(double) * values.size());
  Sample sample;
  const double* v = values.data();
  for (std::size_t i = 0; i < rays; ++i, v += kRayDoubles) {
    solvers::RayMatch ray{v[0], v[1], {v[2], v[3], v[4]}, {v[5], v[6], v[7]}, bytes[i] % kCameras};
    for (const solvers::RayMatch& earlier : sample.rays)
      if (earlier.camera == ray.camera) ray.centre = earlier.centre;
    sample.rays.push_back(ray);
  }
  for (std::size_t i = 0; i < points; ++i, v += kPointDoubles) sample.points.push_back({v[0], v[1], {v[2], v[3], v[4]}});
  return sample;
}

inline std::string encodeSample(const Sample& sample) {
  std::string bytes;
  std::vector<double> values;
  for (const solvers::RayMatch& ray : sample.rays) {
    bytes.push_back(static_cast<char>(ray.camera));
    values.insert(values.end(), {ray.u, ray.v, ray.centre[0], ray.centre[1], ray.centre[2], ray.direction[0], ray.direction[1],
                                 ray.direction[2]});
  }
  for (const solvers::PointMatch& match : sample.points)
    values.insert(values.end(), {match.u, match.v, match.point[0], match.point[1], match.point[2]});
  const std::size_t header = bytes.size();
  bytes.resize(header + sizeof(double) * values.size());
  std::memcpy(&bytes[header], values.data(), sizeof(double) * values.size());
  return bytes;
}

}  // namespace fuzz
}  // namespace hybridgv
