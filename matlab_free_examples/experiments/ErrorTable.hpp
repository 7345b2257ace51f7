// Errors and times of several methods over many scenes; one row per method.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "../common/CsvFile.hpp"
#include "../common/processorSeconds.hpp"
#include "MinimalProblem.hpp"
#include "common/PoseError.hpp"
#include "common/Statistics.hpp"

// Of the solution nearest to the truth in rotation and focal length together; all infinite if there is no solution.
inline PoseError errorOfNearest(const hybridgv::FocalPoses& solutions, const hybridgv::FocalPose& truth) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PoseError error{kInfinity, kInfinity, kInfinity};
  double nearest = kInfinity;
  for (const hybridgv::FocalPose& pose : solutions) {
    const double distance = hybridgv::test::poseDistance(pose, truth);
    if (distance < nearest) {
      nearest = distance;
      error = poseError(pose, truth);
    }
  }
  error.focalPercent = std::abs(error.focalPercent);
  return error;
}

class ErrorTable {
 public:
  using Key = std::vector<std::string>;  // the first columns

  // Runs `solve`, which returns poses, and files their error and the processor time taken (and the iterations, read afterwards).
  template <class Solve>
  void add(const Key& key, const hybridgv::FocalPose& truth, const Solve& solve, const int* iterations = nullptr) {
    const double start = processorSeconds();
    const hybridgv::FocalPoses poses = solve();
    const double seconds = processorSeconds() - start;
    const PoseError error = errorOfNearest(poses, truth);
    if (rows_.count(key) == 0) order_.push_back(key);
    Row& row = rows_[key];
    row.rotation.push_back(error.rotationDeg);
    row.position.push_back(error.position);
    row.focal.push_back(error.focalPercent);
    row.microseconds.push_back(1e6 * seconds);
    row.good += error.rotationDeg < 5 && error.focalPercent < 20;
    if (iterations) row.iterations.push_back(*iterations);
  }

  void write(const std::string& folder, const std::string& name, const std::string& remark, const std::string& keyColumns) const {
    CsvFile csv(folder, name,
                {remark, "good_percent: rotation below 5 degrees and focal length within 20 %",
                 "other columns: medians; position: units, cube side 10; microseconds of processor time"},
                keyColumns + ",good_percent,rotation_deg,position,focal_percent,microseconds,iterations");
    for (const Key& key : order_) {
      const Row& row = rows_.at(key);
      std::string start = key[0];
      for (std::size_t i = 1; i < key.size(); ++i) start += "," + key[i];
      csv.row(start, 100.0 * row.good / static_cast<double>(row.rotation.size()), median(row.rotation), median(row.position),
              median(row.focal), median(row.microseconds), median(row.iterations));
    }
  }

 private:
  struct Row {
    std::vector<double> rotation, position, focal, microseconds, iterations;
    int good = 0;  // rotation below 5 degrees, focal length within 20 %
  };
  std::vector<Key> order_;
  std::map<Key, Row> rows_;
};
