// A camera prepared for many points: from rays to pixels and back.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "PlaneDistortion.hpp"
#include "hybridgv/adapters/sfm/Camera.hpp"

namespace hybridgv {
namespace sfm {

class Lens {
 public:
  // The camera must have no fault (findCameraFault).
  explicit Lens(const Camera& camera);

  // Pixels per radian on the axis, horizontally.
  double focalLength() const { return fx_; }
  // Unit length; empty if the pixel is the image of nothing.
  std::optional<Eigen::Vector3d> ray(double x, double y) const;
  // The pixel of a point in the camera's frame; empty if the camera cannot see it.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;
  // (X/Z, Y/Z) of the ray, for Z > 0, and back.
  std::optional<Eigen::Vector2d> plane(double x, double y) const;
  std::optional<Eigen::Vector2d> projectPlane(const Eigen::Vector2d& point) const;

 private:
  // The image before focal lengths and principal point: of the plane Z = 1, or of the angle to the axis times the direction
  // across it, both distorted; or one of the models in closed form.
  enum class Kind { Plane, PlaneInverse, Angle, Fov, Division, Eucm, Sphere };

  std::optional<Eigen::Vector2d> distorted(const Eigen::Vector2d& point) const;
  std::optional<Eigen::Vector2d> undistorted(const Eigen::Vector2d& image) const;
  std::optional<Eigen::Vector3d> direction(const Eigen::Vector2d& image) const;
  std::optional<Eigen::Vector2d> image(const Eigen::Vector3d& point) const;

  Kind kind_ = Kind::Plane;
  double fx_ = 1, fy_ = 1, cx_ = 0, cy_ = 0;
  PlaneDistortion first_, second_;  // applied in this order
  double a_ = 0, b_ = 0;            // parameters of the models in closed form
};

}  // namespace sfm
}  // namespace hybridgv
