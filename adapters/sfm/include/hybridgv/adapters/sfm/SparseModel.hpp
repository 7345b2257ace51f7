/// \file
/// \brief A sparse model: images with known poses and the 3D points that they see.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hybridgv/adapters/sfm/Camera.hpp"

namespace hybridgv {
namespace sfm {

/// A feature in an image.
struct Observation {
  /// The feature belongs to no point.
  static constexpr std::size_t kNoPoint = static_cast<std::size_t>(-1);

  double x = 0;                  ///< [px] as stored in the file, distorted
  double y = 0;                  ///< [px] as stored in the file, distorted
  std::size_t point = kNoPoint;  ///< index into SparseModel::points, or kNoPoint
};

/// An image of the map. Its pose has the meaning of FocalPose: a point X of the model is at rotation^T (X - position) in the
/// camera's frame, whose z axis looks forward and whose y axis points down in the image. (The files store the inverse; the readers
/// convert.)
struct Image {
  std::uint32_t id = 0;    ///< the number in the file
  std::string name;        ///< as in the file
  std::size_t camera = 0;  ///< index into SparseModel::cameras
  bool registered = true;  ///< false: the file lists the image without a pose that can be used, or its camera cannot be used
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< camera -> model
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< centre of the camera in the model's frame
  std::vector<Observation> observations;                   ///< its features
  /// The pose as a COLMAP file has it, qw, qx, qy, qz, tx, ty, tz of x_camera = R(q) X + t; all zero: from elsewhere. The writers
  /// write it again, bit by bit, as long as rotation and position are those that it stands for.
  std::array<double, 7> storedPose{};
  /// An image that is not registered and is written again as it was read, with its observations: its camera alone cannot be used.
  /// False: it has no observations.
  bool carried = false;
};

/// One observation of a point: `SparseModel::images[image].observations[observation]`.
struct TrackElement {
  std::size_t image = 0;        ///< index into SparseModel::images
  std::size_t observation = 0;  ///< index into Image::observations
};

/// A 3D point.
struct Point {
  std::uint64_t id = 0;                                ///< the number in the file
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in the model's frame
  std::array<std::uint8_t, 3> colour{};                ///< red, green, blue
  double error = -1;                                   ///< mean reprojection error [px] as stored in the file, -1 = unknown
  std::vector<TrackElement> track;                     ///< who sees it; may name an image twice
};

/// A sensor by COLMAP's numbers: type 0 is a camera of the model, whose id is `id`; other types (1 is an inertial unit) are kept as
/// they are.
struct SensorId {
  std::int32_t type = 0;  ///< 0 = camera
  std::uint32_t id = 0;   ///< of a camera: Camera::id
};

/// A sensor of a rig.
struct RigSensor {
  SensorId sensor;  ///< which one
  /// x_sensor = R(q) x_rig + t as in COLMAP's files: qw, qx, qy, qz, tx, ty, tz; empty if it is not known, and for the first
  /// sensor of a rig, whose frame is the rig's.
  std::vector<double> sensorFromRig;
};

/// Sensors that are mounted together (COLMAP 3.12 and later). Not the generalized camera of the library.
struct SensorRig {
  std::uint32_t id = 0;            ///< the number in the file
  std::vector<RigSensor> sensors;  ///< the first one is the reference
};

/// One thing that a sensor has recorded in a frame; of a camera: an image.
struct FrameData {
  SensorId sensor;       ///< which one
  std::uint64_t id = 0;  ///< of an image: Image::id
};

/// What the sensors of a rig have recorded at one time (COLMAP 3.12 and later).
struct Frame {
  std::uint32_t id = 0;                                     ///< the number in the file
  std::uint32_t rigId = 0;                                  ///< SensorRig::id
  std::array<double, 7> rigFromWorld{1, 0, 0, 0, 0, 0, 0};  ///< qw, qx, qy, qz, tx, ty, tz as in COLMAP's files
  std::vector<FrameData> data;                              ///< what has been recorded
};

/// Indices refer to these vectors and are always valid in a model that a reader has returned, and
/// `images[t.image].observations[t.observation].point` is the point's own index for each element t of its track.
struct SparseModel {
  std::vector<Camera> cameras;  ///< intrinsic parameters, each shared by one or more images
  std::vector<Image> images;    ///< the images of the map
  std::vector<Point> points;    ///< the 3D points
  /// COLMAP's rigs and frames (3.12 and later), carried along: the poses that count are those of the images. Empty if the files
  /// have none.
  std::vector<SensorRig> rigs;
  std::vector<Frame> frames;  ///< likewise
};

}  // namespace sfm
}  // namespace hybridgv
