#include "solvers/complex_rays/Frame.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "solvers/meetInFront.hpp"

namespace hybridgv {
namespace solvers {
namespace complex_rays {

using Eigen::Matrix3d;
using Eigen::Vector3cd;
using Eigen::Vector3d;

static const Number kI(0, 1);

static Vector3d realPart(const ComplexNumber (&a)[3]) { return {a[0].re, a[1].re, a[2].re}; }

Matrix3d Frame::turnToThirdAxis(const Vector3d& third) {
  const Vector3d first = third.unitOrthogonal();
  Matrix3d turn;
  turn << first.transpose(), third.cross(first).transpose(), third.transpose();
  return turn;
}

// The rotation Q that maximizes the trace of Q^T K; about the third axis if that must stay.
static Matrix3d closestRotation(const Matrix3d& K, bool keepThirdAxis) {
  if (keepThirdAxis)
    return Eigen::AngleAxisd(std::atan2(K(1, 0) - K(0, 1), K(0, 0) + K(1, 1)), Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::JacobiSVD<Matrix3d> svd(K, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handedness = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Vector3d(1, 1, handedness < 0 ? -1 : 1).asDiagonal() * svd.matrixV().transpose();
}

void Alignment::addVectors(const ComplexNumber (&startDirection)[3], const ComplexNumber (&direction)[3],
                           const ComplexNumber (&startMoment)[3], const ComplexNumber (&moment)[3]) {
  vectors_ += realPart(startDirection) * realPart(direction).transpose() + realPart(startMoment) * realPart(moment).transpose();
}

void Alignment::addImage(const ComplexNumber& start, const ComplexNumber& startBar, const ComplexNumber& sample) {
  images_ += std::conj(number(sample)) * (number(start) + std::conj(number(startBar)));
}

void Alignment::apply(bool keepThirdAxis, Frame* frame) const {
  frame->turn = closestRotation(vectors_, keepThirdAxis) * frame->turn;
  if (std::abs(images_) > 0) frame->phase *= images_ / std::abs(images_);
}

void scaleLike(const ComplexNumber (&startDirection)[3], const ComplexNumber (&startMoment)[3], ComplexNumber (&direction)[3],
               ComplexNumber (&moment)[3]) {
  const Vector3d q0 = realPart(startDirection), m0 = realPart(startMoment), q = realPart(direction), m = realPart(moment);
  const double scale = std::copysign(std::sqrt((q0.squaredNorm() + m0.squaredNorm()) / (q.squaredNorm() + m.squaredNorm())),
                                     q0.dot(q) + m0.dot(m));
  assign(scale * q, direction);
  assign(scale * m, moment);
}

// n0 / (1+xy) and z0 for y = conj x
static Vector3d viewingDirection(const Number& x) {
  return Vector3d(2 * x.real(), 2 * x.imag(), 1 - std::norm(x)) / (1 + std::norm(x));
}
static Vector3cd imagePlane(const Number& x) { return {1.0 - x * x, kI * (1.0 + x * x), -2.0 * x}; }

Orientation orientationOf(const FocalPose& pose, const Frame& frame) {
  const Matrix3d rows = pose.rotation.transpose() * frame.turn.transpose();
  const Vector3d n = rows.row(2).transpose();
  const Number x = Number(n[0], n[1]) / (1 + n[2]);
  // z = f phase (r1 + i r2) = L z0(x) / (1+|x|^2), z0.conj(z0) = 2 (1+|x|^2)^2
  const Vector3cd z = pose.focalLength / frame.imageScale * frame.phase *
                      (rows.row(0).transpose().cast<Number>() + kI * rows.row(1).transpose().cast<Number>());
  const Number L = imagePlane(x).dot(z) / (2 * (1 + std::norm(x)));
  return {x, 1.0 / L};
}

Orientation realOrientation(const Number& x, const Number& y, const Number& alpha, const Number& beta) {
  return {(x + std::conj(y)) / 2.0, (beta + std::conj(alpha)) / 2.0};
}

void setOrientation(const Orientation& orientation, const Frame& frame, FocalPose* pose) {
  const Number &x = orientation.x, &beta = orientation.beta;
  const double f = 1 / std::abs(beta);
  const Vector3d n = viewingDirection(x);
  const Vector3cd z = std::conj(frame.phase) / (beta * (1 + std::norm(x))) * imagePlane(x);
  Matrix3d rows;
  rows << z.real().transpose() / f, z.imag().transpose() / f, n.transpose();
  pose->rotation = (rows * frame.turn).transpose();
  pose->focalLength = f * frame.imageScale;
}

bool agrees(const FocalPose& pose, const RayMatch& ray, double imageScale) {
  // Distance of the image point from the image of its ray.
  constexpr double kLargestResidual = 1e-7;
  const double f = pose.focalLength;
  const Vector3d direction = pose.rotation.transpose() * ray.direction;
  const Vector3d centre = pose.rotation.transpose() * (ray.centre - pose.position);
  const Vector3d normal = direction.cross(centre), line(normal[0], normal[1], normal[2] * f);  // line.(u, v, 1) = 0
  const double residual = std::abs(line.dot(Vector3d(ray.u, ray.v, 1)));
  return residual < kLargestResidual * imageScale * line.head<2>().norm() &&
         meetInFront(ray.u / imageScale, ray.v / imageScale, f / imageScale, direction, centre.normalized());
}

}  // namespace complex_rays
}  // namespace solvers
}  // namespace hybridgv
