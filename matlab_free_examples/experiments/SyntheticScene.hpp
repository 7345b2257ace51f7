// The scenes of the paper's synthetic experiments: points in a 10 x 10 x 10 cube around the origin, a query of unknown focal
// length and five calibrated rig cameras at a distance of 15 .. 25 that look at the origin, images of 1000 x 1000 px.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"

constexpr int kRigCameras = 5;

// How the rig cameras stand to the query. All look at the origin from 15 .. 25, whatever the motion:
//   random    from directions of their own
//   forward   from the query's direction, up to 5 degrees: they differ in distance mainly
//   sideways  from directions up to 45 degrees to the left or right of the query and up to 5 degrees above or below, as upright as
//             the query
enum class Motion { Random, Forward, Sideways };
inline const char* toString(Motion motion) {
  return motion == Motion::Random ? "random" : motion == Motion::Forward ? "forward" : "sideways";
}

struct Noise {
  double imagePx;       // standard deviation per coordinate, in the query and in the rig's images
  double pointPercent;  // standard deviation of the 3D points per coordinate, share of their depth in the query
};

// Enough correspondences for every minimal solver: 2D-2D 0 .. 4 from one rig camera each, 5 .. 9 all from the first; four 2D-3D.
struct SyntheticScene {
  hybridgv::FocalPose query;
  hybridgv::NoncentralHybridAdapter adapter;
};

inline hybridgv::FocalPose cameraLike(const hybridgv::FocalPose& query, hybridgv::test::Random& random, double sidewaysDeg,
                                      double otherDeg) {
  const double sideways = random.uniform(-sidewaysDeg, sidewaysDeg) * M_PI / 180;
  const double other = random.uniform(-otherDeg, otherDeg) * M_PI / 180;
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(sideways, query.rotation.col(1)) * Eigen::AngleAxisd(other, query.rotation.col(0))).toRotationMatrix();
  hybridgv::FocalPose camera;
  camera.rotation = turn * query.rotation;
  camera.position = -random.uniform(15, 25) * camera.rotation.col(2);
  return camera;
}

// The same seed gives the same scene and the same directions of all errors, whatever their size.
inline SyntheticScene makeSyntheticScene(hybridgv::test::Random random, Motion motion, const Noise& noise) {
  using namespace hybridgv::test;
  using Eigen::Vector3d;
  const double focalLength = random.uniform(500, 2000);
  const hybridgv::FocalPose query = cameraLookingAtOrigin(random, random.uniform(15, 25), focalLength);
  std::vector<hybridgv::FocalPose> rig;
  for (int k = 0; k < kRigCameras; ++k) {
    rig.push_back(motion == Motion::Random    ? cameraLookingAtOrigin(random, random.uniform(15, 25), 1)
                  : motion == Motion::Forward ? cameraLike(query, random, 5, 5)
                                              : cameraLike(query, random, 45, 5));
    rig.back().focalLength = random.uniform(500, 2000);
  }
  const auto visiblePoint = [&](const hybridgv::FocalPose& camera) {
    Vector3d point = random.vector(-5, 5);
    while (!isVisible(query, point) || !isVisible(camera, point)) point = random.vector(-5, 5);
    return point;
  };
  const auto imageOf = [&](const hybridgv::FocalPose& camera, const Vector3d& point) {
    const Vector3d error(random.normal(), random.normal(), 0);
    return Vector3d(project(camera, point).homogeneous() + noise.imagePx * error);
  };

  std::vector<Vector3d> imagePoints2d2d, bearings, offsets, imagePoints2d3d, points;
  std::vector<Eigen::Matrix3d> rotations;
  std::vector<int> cameras;
  for (int i = 0; i < 2 * kRigCameras; ++i) {
    const int k = i < kRigCameras ? i : 0;
    const hybridgv::FocalPose& camera = rig[static_cast<std::size_t>(k)];
    const Vector3d point = visiblePoint(camera);
    imagePoints2d2d.push_back(imageOf(query, point));
    bearings.push_back(imageOf(camera, point).cwiseQuotient(Vector3d(camera.focalLength, camera.focalLength, 1)));
    cameras.push_back(k);
  }
  for (int i = 0; i < 4; ++i) {
    const Vector3d point = visiblePoint(query);
    imagePoints2d3d.push_back(imageOf(query, point));
    const Vector3d error(random.normal(), random.normal(), random.normal());
    points.push_back(point + noise.pointPercent / 100 * toCamera(query, point)[2] * error);
  }
  for (const hybridgv::FocalPose& camera : rig) {
    offsets.push_back(camera.position);
    rotations.push_back(camera.rotation);
  }
  return {query, {imagePoints2d2d, bearings, cameras, offsets, rotations, imagePoints2d3d, points}};
}
