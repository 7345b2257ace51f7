// Coordinates in which a sample comes close to a start system, and a camera in the unknowns of Forms.hpp.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "solvers/MinimalSolver.hpp"
#include "solvers/complex_rays/straightWay.hpp"

namespace hybridgv {
namespace solvers {
namespace complex_rays {

using Number = std::complex<double>;

// Rig coordinates X' = turn (X - origin) / length, image coordinates pi' = phase pi / imageScale.
struct Frame {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double length = 1;
  Number phase = 1;
  double imageScale = 1;

  ComplexNumber image(double u, double v) const { return plain(phase * Number(u, v) / imageScale); }
  // A rotation whose third row is the given unit vector.
  static Eigen::Matrix3d turnToThirdAxis(const Eigen::Vector3d& third);
};

inline ComplexNumber conjugate(const ComplexNumber& a) { return {a.re, -a.im}; }
inline void assign(const Eigen::Vector3d& from, ComplexNumber (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = {from[k], 0};
}

// The data of ray j: a ray through `centre` (in the frame's coordinates).
template <int Rays>
void setRay(const Frame& frame, const RayMatch& ray, const Eigen::Vector3d& centre, int j, ComplexRays<Rays>* to) {
  const Eigen::Vector3d direction = frame.turn * ray.direction;
  assign(direction, to->direction[j]);
  assign(direction.cross(centre), to->moment[j]);
  to->image[j] = frame.image(ray.u, ray.v);
  to->imageBar[j] = conjugate(to->image[j]);
}

// Turns the rig's and the image's axes so that a sample comes close to the real parts of a start system: least squares over
// directions and moments of the rays, and over the image points.
class Alignment {
 public:
  template <int Rays>
  void addRays(const ComplexRays<Rays>& start, const ComplexRays<Rays>& sample) {
    for (int j = 0; j < Rays; ++j) {
      addVectors(start.direction[j], sample.direction[j], start.moment[j], sample.moment[j]);
      addImage(start.image[j], start.imageBar[j], sample.image[j]);
    }
  }
  void addImage(const ComplexNumber& start, const ComplexNumber& startBar, const ComplexNumber& sample);
  void apply(bool keepThirdAxis, Frame* frame) const;

 private:
  void addVectors(const ComplexNumber (&startDirection)[3], const ComplexNumber (&direction)[3],
                  const ComplexNumber (&startMoment)[3], const ComplexNumber (&moment)[3]);

  Eigen::Matrix3d vectors_ = Eigen::Matrix3d::Zero();
  Number images_ = 0;
};

// The equation of a ray is homogeneous in (direction, moment): gives it the sign and the length of the start system's.
void scaleLike(const ComplexNumber (&startDirection)[3], const ComplexNumber (&startMoment)[3], ComplexNumber (&direction)[3],
               ComplexNumber (&moment)[3]);
template <int Rays>
void scaleRaysLike(const ComplexRays<Rays>& start, ComplexRays<Rays>* sample) {
  for (int j = 0; j < Rays; ++j) scaleLike(start.direction[j], start.moment[j], sample->direction[j], sample->moment[j]);
}

// The unknowns that determine the query's orientation and focal length.
struct Orientation {
  Number x, beta;  // y = conj x, alpha = conj beta
};
// Of a pose, in the frame.
Orientation orientationOf(const FocalPose& pose, const Frame& frame);
// The mean of unknowns that are conjugate up to rounding.
Orientation realOrientation(const Number& x, const Number& y, const Number& alpha, const Number& beta);
// Rotation and focal length of a pose; the position stays as it is.
void setOrientation(const Orientation& orientation, const Frame& frame, FocalPose* pose);

// Is the ray seen at its image point, in front of both cameras? Residuals relative to the image scale.
bool agrees(const FocalPose& pose, const RayMatch& ray, double imageScale);
// A focal length below which image points at the principal point make spurious solutions, relative to the image scale.
constexpr double kSmallestFocalLength = 1e-4;

}  // namespace complex_rays
}  // namespace solvers
}  // namespace hybridgv
