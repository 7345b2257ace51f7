// Wrong calls: std::invalid_argument that names the argument.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "HybridScene.hpp"
#include "SolverConfigurations.hpp"
#include "expectRefused.hpp"

namespace hybridgv {
namespace test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

inline const std::vector<double>& notFinite() {
  static const std::vector<double> values{kNaN, kInfinite, -kInfinite};
  return values;
}

// Twelve 2D-2D correspondences, the first six of camera 0, and eight 2D-3D ones.
inline NoncentralHybridAdapter goodAdapter() {
  Random random(testSeed() + 800);
  NoncentralHybridAdapter adapter = makeAdapter(makeMinimalProblem(random, {6, 2, 2, 1, 1}, 8));
  return adapter;
}

// What an adapter returns for correspondence 0 is replaced, which NoncentralHybridAdapter itself would refuse to hold.
class AlteredAdapter : public NoncentralHybridAdapter {
 public:
  AlteredAdapter() : NoncentralHybridAdapter(goodAdapter()) {}

  std::function<Eigen::Vector3d(Eigen::Vector3d)> imagePoint2d2d = keep<Eigen::Vector3d>;
  std::function<Eigen::Vector3d(Eigen::Vector3d)> bearingVector = keep<Eigen::Vector3d>;
  std::function<Eigen::Vector3d(Eigen::Vector3d)> camOffset = keep<Eigen::Vector3d>;
  std::function<Eigen::Matrix3d(Eigen::Matrix3d)> camRotation = keep<Eigen::Matrix3d>;
  std::function<Eigen::Vector3d(Eigen::Vector3d)> imagePoint2d3d = keep<Eigen::Vector3d>;
  std::function<Eigen::Vector3d(Eigen::Vector3d)> point = keep<Eigen::Vector3d>;
  double rigFocalLength = 0, weight2d2d = 1, weight2d3d = 1;

  Eigen::Vector3d getImagePoint2d2d(std::size_t i) const override {
    const Eigen::Vector3d value = NoncentralHybridAdapter::getImagePoint2d2d(i);
    return i == 0 ? imagePoint2d2d(value) : value;
  }
  Eigen::Vector3d getBearingVector(std::size_t i) const override {
    const Eigen::Vector3d value = NoncentralHybridAdapter::getBearingVector(i);
    return i == 0 ? bearingVector(value) : value;
  }
  Eigen::Vector3d getCamOffset(std::size_t i) const override {
    const Eigen::Vector3d value = NoncentralHybridAdapter::getCamOffset(i);
    return i == 0 ? camOffset(value) : value;
  }
  Eigen::Matrix3d getCamRotation(std::size_t i) const override {
    const Eigen::Matrix3d value = NoncentralHybridAdapter::getCamRotation(i);
    return i == 0 ? camRotation(value) : value;
  }
  Eigen::Vector3d getImagePoint2d3d(std::size_t i) const override {
    const Eigen::Vector3d value = NoncentralHybridAdapter::getImagePoint2d3d(i);
    return i == 0 ? imagePoint2d3d(value) : value;
  }
  Eigen::Vector3d getPoint(std::size_t i) const override {
    const Eigen::Vector3d value = NoncentralHybridAdapter::getPoint(i);
    return i == 0 ? point(value) : value;
  }
  double getRigFocalLength(std::size_t i) const override { return i == 0 ? rigFocalLength : 0; }
  double getWeight2d2d(std::size_t i) const override { return i == 0 ? weight2d2d : 1; }
  double getWeight2d3d(std::size_t i) const override { return i == 0 ? weight2d3d : 1; }

 private:
  template <class T>
  static T keep(T value) {
    return value;
  }
};

// A wrong value in one field of an adapter, and the name that the message must contain.
struct WrongField {
  std::string name;
  std::function<void(AlteredAdapter&)> apply;
  std::string getter;
};

// Every number that an adapter gives for a 2D-2D correspondence, made NaN and infinite, and impossible values.
inline std::vector<WrongField> wrongRayFields() {
  std::vector<WrongField> fields;
  for (const double value : notFinite()) {
    const std::string text = " = " + std::to_string(value);
    for (int k = 0; k < 3; ++k) {
      const auto set = [k, value](Eigen::Vector3d v) {
        v[k] = value;
        return v;
      };
      const std::string entry = "[" + std::to_string(k) + "]" + text;
      fields.push_back({"getImagePoint2d2d" + entry, [=](AlteredAdapter& a) { a.imagePoint2d2d = set; }, "getImagePoint2d2d(0)"});
      fields.push_back({"getBearingVector" + entry, [=](AlteredAdapter& a) { a.bearingVector = set; }, "getBearingVector(0)"});
      fields.push_back({"getCamOffset" + entry, [=](AlteredAdapter& a) { a.camOffset = set; }, "getCamOffset(0)"});
      for (int j = 0; j < 3; ++j) {
        const auto setEntry = [j, k, value](Eigen::Matrix3d m) {
          m(j, k) = value;
          return m;
        };
        fields.push_back({"getCamRotation(" + std::to_string(j) + "," + std::to_string(k) + ")" + text,
                          [=](AlteredAdapter& a) { a.camRotation = setEntry; }, "getCamRotation(0)"});
      }
    }
  }
  const auto zero = [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); };
  const auto atInfinity = [](const Eigen::Vector3d& v) { return Eigen::Vector3d(v[0], v[1], 0); };
  fields.push_back({"image point zero", [=](AlteredAdapter& a) { a.imagePoint2d2d = zero; }, "getImagePoint2d2d(0)"});
  fields.push_back(
      {"image point at infinity", [=](AlteredAdapter& a) { a.imagePoint2d2d = atInfinity; }, "getImagePoint2d2d(0)"});
  fields.push_back({"bearing vector zero", [=](AlteredAdapter& a) { a.bearingVector = zero; }, "getBearingVector(0)"});
  fields.push_back({"rotation zero",
                    [](AlteredAdapter& a) {
                      a.camRotation = [](const Eigen::Matrix3d&) -> Eigen::Matrix3d { return Eigen::Matrix3d::Zero(); };
                    },
                    "getCamRotation(0)"});
  return fields;
}

// Likewise for a 2D-3D correspondence.
inline std::vector<WrongField> wrongPointFields() {
  std::vector<WrongField> fields;
  for (const double value : notFinite())
    for (int k = 0; k < 3; ++k) {
      const auto set = [k, value](Eigen::Vector3d v) {
        v[k] = value;
        return v;
      };
      const std::string entry = "[" + std::to_string(k) + "] = " + std::to_string(value);
      fields.push_back({"getImagePoint2d3d" + entry, [=](AlteredAdapter& a) { a.imagePoint2d3d = set; }, "getImagePoint2d3d(0)"});
      fields.push_back({"getPoint" + entry, [=](AlteredAdapter& a) { a.point = set; }, "getPoint(0)"});
    }
  const auto atInfinity = [](const Eigen::Vector3d& v) { return Eigen::Vector3d(v[0], v[1], 0); };
  fields.push_back(
      {"image point at infinity", [=](AlteredAdapter& a) { a.imagePoint2d3d = atInfinity; }, "getImagePoint2d3d(0)"});
  return fields;
}

// A pose with one wrong number or a rotation that is none.
struct WrongPose {
  std::string name;
  FocalPose pose;
};

inline std::vector<WrongPose> wrongPoses() {
  std::vector<WrongPose> poses;
  for (const double value : notFinite()) {
    const std::string text = " = " + std::to_string(value);
    for (int k = 0; k < 3; ++k) {
      WrongPose wrong{"position[" + std::to_string(k) + "]" + text, {}};
      wrong.pose.position[k] = value;
      poses.push_back(wrong);
      for (int j = 0; j < 3; ++j) {
        WrongPose turned{"rotation(" + std::to_string(j) + "," + std::to_string(k) + ")" + text, {}};
        turned.pose.rotation(j, k) = value;
        poses.push_back(turned);
      }
    }
    poses.push_back({"focalLength" + text, {}});
    poses.back().pose.focalLength = value;
  }
  for (const double value : {0.0, -1000.0}) {
    poses.push_back({"focalLength = " + std::to_string(value), {}});
    poses.back().pose.focalLength = value;
  }
  poses.push_back({"reflection", {}});
  poses.back().pose.rotation(2, 2) = -1;
  poses.push_back({"scaled rotation", {}});
  poses.back().pose.rotation *= 1.1;
  return poses;
}

}  // namespace test
}  // namespace hybridgv
