#include "solvers/h51f/Reduction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "solvers/h51f/StartSystems.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using complex_rays::Number;
using Eigen::Vector3d;

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
    const Vector3d toCentre = rays[0].centre - point.point;
    frame->length = toCentre.norm() / kSharedCentre;
    frame->turn = Frame::turnToThirdAxis(toCentre.normalized());
  }
  return frame->imageScale > 0 && frame->length > 0;
}

void alignWith(const StartSystem& startSystem, const RayMatch* rays, const PointMatch& point, Frame* frame) {
  const Parameters& start = startSystem.parameters;
  const Parameters p = parametersIn(*frame, startSystem.sharing, rays, point);
  complex_rays::Alignment alignment;
  alignment.addRays<kRays>(start, p);
  alignment.addImage(start.pointImage, start.pointImageBar, p.pointImage);
  alignment.apply(startSystem.sharing != Sharing::AtMostTwo, frame);
}

Parameters parametersIn(const Frame& frame, Sharing sharing, const RayMatch* rays, const PointMatch& point) {
  Parameters p;
  for (int j = 0; j < kRays; ++j) {
    Vector3d centre(0, 0, kSharedCentre);
    if (j >= caseOf(sharing).sharedRays) centre = frame.turn * (rays[j].centre - frame.origin) / frame.length;
    complex_rays::setRay<kRays>(frame, rays[j], centre, j, &p);
  }
  p.pointImage = frame.image(point.u, point.v);
  p.pointImageBar = complex_rays::conjugate(p.pointImage);
  return p;
}

Solution solutionOf(const FocalPose& pose, const Frame& frame, const PointMatch& point) {
  const complex_rays::Orientation orientation = complex_rays::orientationOf(pose, frame);
  const double depth = pose.rotation.col(2).dot(point.point - pose.position) / frame.length;
  return {orientation.x, std::conj(orientation.x), std::conj(orientation.beta), orientation.beta, depth};
}

FocalPose poseOf(const Solution& solution, const Frame& frame, const PointMatch& point) {
  FocalPose pose;
  complex_rays::setOrientation(complex_rays::realOrientation(solution.x, solution.y, solution.alpha, solution.beta), frame,
                               &pose);
  const Vector3d viewingRay(point.u / pose.focalLength, point.v / pose.focalLength, 1);
  pose.position = point.point - solution.d.real() * frame.length * (pose.rotation * viewingRay);
  return pose;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
