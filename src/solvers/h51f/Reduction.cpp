#include "solvers/h51f/Reduction.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "solvers/h51f/StartSystems.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using Eigen::Matrix3d;
using Eigen::Vector3cd;
using Eigen::Vector3d;
using Number = std::complex<double>;

static const Number kI(0, 1);

static Number number(const ComplexNumber& a) { return {a.re, a.im}; }
static ComplexNumber plain(const Number& a) { return {a.real(), a.imag()}; }
static Vector3d realPart(const ComplexNumber (&a)[3]) { return {a[0].re, a[1].re, a[2].re}; }
static void assign(const Vector3d& from, ComplexNumber (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = {from[k], 0};
}

// n0 / (1+xy) and z0 for y = conj x
static Vector3d viewingDirection(const Number& x) {
  return Vector3d(2 * x.real(), 2 * x.imag(), 1 - std::norm(x)) / (1 + std::norm(x));
}
static Vector3cd imagePlane(const Number& x) { return {1.0 - x * x, kI * (1.0 + x * x), -2.0 * x}; }

bool sameCentre(const RayMatch& a, const RayMatch& b, const Vector3d& point) {
  return a.camera == b.camera || (a.centre - b.centre).norm() <= kSameCentre * (a.centre - point).norm();
}

Sharing arrange(const RayMatch* rays, const PointMatch& point, RayMatch* arranged) {
  int members[kRays] = {}, largest = 0;
  for (int j = 0; j < kRays; ++j) {
    for (int k = 0; k < kRays; ++k) members[j] += sameCentre(rays[j], rays[k], point.point);
    if (members[j] > members[largest]) largest = j;
  }
  const Sharing sharing = sharingOf(members[largest]);
  double key[kRays];
  for (int j = 0; j < kRays; ++j) {
    const bool first = sharing == Sharing::AtMostTwo || sameCentre(rays[largest], rays[j], point.point);
    key[j] = std::arg(Number(rays[j].u, rays[j].v) * Number(point.u, -point.v)) + (first ? 0 : 10);
  }
  int order[kRays];
  std::iota(order, order + kRays, 0);
  std::stable_sort(order, order + kRays, [&key](int a, int b) { return key[a] < key[b]; });
  for (int j = 0; j < kRays; ++j) arranged[j] = rays[order[j]];
  return sharing;
}

bool normalize(Sharing sharing, const RayMatch* rays, const PointMatch& point, Frame* frame) {
  *frame = Frame();
  frame->origin = point.point;
  double meanDistance = 0, meanRadius = std::hypot(point.u, point.v) / (kRays + 1);
  for (int j = 0; j < kRays; ++j) {
    meanDistance += rays[j].direction.cross(rays[j].centre - point.point).norm() / kRays;
    meanRadius += std::hypot(rays[j].u, rays[j].v) / (kRays + 1);
  }
  frame->imageScale = 4 * meanRadius;
  frame->length = meanDistance;
  if (sharing != Sharing::AtMostTwo) {
    const Vector3d toCentre = rays[0].centre - point.point, third = toCentre.normalized(), first = third.unitOrthogonal();
    frame->length = toCentre.norm() / kSharedCentre;
    frame->turn << first.transpose(), third.cross(first).transpose(), third.transpose();
  }
  return frame->imageScale > 0 && frame->length > 0;
}

// The rotation Q that maximizes the trace of Q^T K; about the third axis if that must stay.
static Matrix3d closestRotation(const Matrix3d& K, bool keepThirdAxis) {
  if (keepThirdAxis)
    return Eigen::AngleAxisd(std::atan2(K(1, 0) - K(0, 1), K(0, 0) + K(1, 1)), Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::JacobiSVD<Matrix3d> svd(K, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handedness = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Vector3d(1, 1, handedness < 0 ? -1 : 1).asDiagonal() * svd.matrixV().transpose();
}

void alignWith(const StartSystem& startSystem, const RayMatch* rays, const PointMatch& point, Frame* frame) {
  const Parameters& start = startSystem.parameters;
  const Parameters p = parametersIn(*frame, startSystem.sharing, rays, point);
  Matrix3d K = Matrix3d::Zero();
  Number w = 0;
  const auto addImage = [&w](const ComplexNumber& image, const ComplexNumber& startImage, const ComplexNumber& startImageBar) {
    w += std::conj(number(image)) * (number(startImage) + std::conj(number(startImageBar)));
  };
  for (int j = 0; j < kRays; ++j) {
    K += realPart(start.direction[j]) * realPart(p.direction[j]).transpose() +
         realPart(start.moment[j]) * realPart(p.moment[j]).transpose();
    addImage(p.image[j], start.image[j], start.imageBar[j]);
  }
  addImage(p.pointImage, start.pointImage, start.pointImageBar);
  frame->turn = closestRotation(K, startSystem.sharing != Sharing::AtMostTwo) * frame->turn;
  if (std::abs(w) > 0) frame->phase *= w / std::abs(w);
}

Parameters parametersIn(const Frame& frame, Sharing sharing, const RayMatch* rays, const PointMatch& point) {
  Parameters p;
  const auto image = [&frame](double u, double v) { return frame.phase * Number(u, v) / frame.imageScale; };
  for (int j = 0; j < kRays; ++j) {
    Vector3d centre(0, 0, kSharedCentre);
    if (j >= caseOf(sharing).sharedRays) centre = frame.turn * (rays[j].centre - frame.origin) / frame.length;
    const Vector3d direction = frame.turn * rays[j].direction;
    assign(direction, p.direction[j]);
    assign(direction.cross(centre), p.moment[j]);
    p.image[j] = plain(image(rays[j].u, rays[j].v));
    p.imageBar[j] = plain(std::conj(number(p.image[j])));
  }
  p.pointImage = plain(image(point.u, point.v));
  p.pointImageBar = plain(std::conj(number(p.pointImage)));
  return p;
}

void scaleRaysLike(const Parameters& start, Parameters* parameters) {
  for (int j = 0; j < kRays; ++j) {
    const Vector3d q0 = realPart(start.direction[j]), m0 = realPart(start.moment[j]);
    const Vector3d q = realPart(parameters->direction[j]), m = realPart(parameters->moment[j]);
    const double scale = std::copysign(std::sqrt((q0.squaredNorm() + m0.squaredNorm()) / (q.squaredNorm() + m.squaredNorm())),
                                       q0.dot(q) + m0.dot(m));
    assign(scale * q, parameters->direction[j]);
    assign(scale * m, parameters->moment[j]);
  }
}

Solution solutionOf(const FocalPose& pose, const Frame& frame, const PointMatch& point) {
  const Matrix3d rows = pose.rotation.transpose() * frame.turn.transpose();
  const double depth = pose.rotation.col(2).dot(point.point - pose.position) / frame.length;
  const Vector3d n = rows.row(2).transpose();
  const Number x = Number(n[0], n[1]) / (1 + n[2]);
  // z = f phase (r1 + i r2) = L z0(x) / (1+|x|^2), z0.conj(z0) = 2 (1+|x|^2)^2
  const Vector3cd z = pose.focalLength / frame.imageScale * frame.phase *
                      (rows.row(0).transpose().cast<Number>() + kI * rows.row(1).transpose().cast<Number>());
  const Number L = imagePlane(x).dot(z) / (2 * (1 + std::norm(x)));
  return {x, std::conj(x), 1.0 / std::conj(L), 1.0 / L, depth};
}

FocalPose poseOf(const Solution& solution, const Frame& frame, const PointMatch& point) {
  const Number x = (solution.x + std::conj(solution.y)) / 2.0, beta = (solution.beta + std::conj(solution.alpha)) / 2.0;
  const double f = 1 / std::abs(beta);
  const Vector3d n = viewingDirection(x);
  const Vector3cd z = std::conj(frame.phase) / (beta * (1 + std::norm(x))) * imagePlane(x);
  Matrix3d rows;
  rows << z.real().transpose() / f, z.imag().transpose() / f, n.transpose();
  FocalPose pose;
  pose.rotation = (rows * frame.turn).transpose();
  pose.focalLength = f * frame.imageScale;
  const Vector3d viewingRay(point.u / pose.focalLength, point.v / pose.focalLength, 1);
  pose.position = point.point - solution.d.real() * frame.length * (pose.rotation * viewingRay);
  return pose;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
