#include "solvers/h70f/Reduction.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace solvers {
namespace h70f {

using complex_rays::Number;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Groups::Groups(const RayMatch* rays) {
  double extent = 0;
  for (int j = 0; j < kRays; ++j)
    for (int k = 0; k < j; ++k) extent = std::max(extent, (rays[j].centre - rays[k].centre).norm());
  int met[kRays], sizes[kRays] = {}, order[kRays];
  for (int j = 0; j < kRays; ++j) {
    met[j] = count_;
    for (int k = 0; k < j && met[j] == count_; ++k)
      if (rays[j].camera == rays[k].camera || (rays[j].centre - rays[k].centre).norm() <= kSameCentre * extent) met[j] = met[k];
    order[count_] = count_;
    count_ += met[j] == count_;
    ++sizes[met[j]];
  }
  std::stable_sort(order, order + count_, [&sizes](int a, int b) { return sizes[a] > sizes[b]; });
  for (int g = 0; g < count_; ++g) {
    size_[g] = sizes[order[g]];
    for (int j = 0; j < kRays; ++j)
      if (met[j] == order[g]) group_[j] = g;
  }
}

namespace {

// The rays of a sample in the parts of a SharingCase, each in the order of the angle of the image points, and turned.
class Arrangement {
 public:
  Arrangement(const RayMatch* rays, const Groups& groups, const StartSystem& start) : rays_(rays), start_(start.parameters) {
    const SharingCase& sharing = caseOf(start.sharing);
    const int sizes[kParts] = {sharing.unshared(), sharing.secondGroup, sharing.firstGroup};
    std::copy(sizes, sizes + kParts, size_);
    for (int j = 0; j < kRays; ++j) {
      order_[j] = j;
      const bool isShared = groups.of(j) == 0 ? sharing.firstGroup > 0 : groups.of(j) == 1 && sharing.secondGroup > 0;
      part_[j] = !isShared ? 0 : groups.of(j) == 0 ? 2 : 1;
    }
    const auto precedes = [this](int a, int b) {
      return part_[a] != part_[b] ? part_[a] < part_[b] : std::arg(image(a)) < std::arg(image(b));
    };
    std::stable_sort(order_, order_ + kRays, precedes);
  }

  // Takes the cyclic order of each part that makes |sum conj(pi) start's pi| largest.
  void turnToStart() {
    int best[kRays];
    double largest = -1;
    for (int i = 0; i < std::max(size_[0], 1); turn(0), ++i)
      for (int j = 0; j < std::max(size_[1], 1); turn(1), ++j)
        for (int k = 0; k < std::max(size_[2], 1); turn(2), ++k) {
          const double agreement = std::abs(correlation());
          if (!(agreement > largest)) continue;
          largest = agreement;
          std::copy(order_, order_ + kRays, best);
        }
    if (largest >= 0) std::copy(best, best + kRays, order_);
  }

  void copyTo(RayMatch* arranged) const {
    for (int j = 0; j < kRays; ++j) arranged[j] = rays_[order_[j]];
  }

 private:
  static constexpr int kParts = 3;

  Number image(int ray) const { return {rays_[ray].u, rays_[ray].v}; }
  void turn(int part) {
    int* begin = order_;
    for (int p = 0; p < part; ++p) begin += size_[p];
    if (size_[part] > 1) std::rotate(begin, begin + 1, begin + size_[part]);
  }
  Number correlation() const {
    Number sum = 0;
    for (int j = 0; j < kRays; ++j)
      sum += std::conj(image(order_[j])) * (number(start_.image[j]) + std::conj(number(start_.imageBar[j])));
    return sum;
  }

  const RayMatch* rays_;
  const Parameters& start_;
  int order_[kRays], part_[kRays], size_[kParts];
};

}  // namespace

Sharing sharingOf(const Groups& groups) { return sharingOf(groups.size(0), groups.size(1)); }

void arrange(const RayMatch* rays, const Groups& groups, const StartSystem& start, RayMatch* arranged) {
  Arrangement arrangement(rays, groups, start);
  arrangement.turnToStart();
  arrangement.copyTo(arranged);
}

// The point with the least sum of squared distances from the rays; false if it is not determined.
static bool closestPoint(const RayMatch* rays, Vector3d* point) {
  Matrix3d sum = Matrix3d::Zero();
  Vector3d side = Vector3d::Zero();
  for (int j = 0; j < kRays; ++j) {
    const Matrix3d across = Matrix3d::Identity() - rays[j].direction * rays[j].direction.transpose();
    sum += across;
    side += across * rays[j].centre;
  }
  *point = sum.inverse() * side;
  return point->allFinite();
}

bool normalize(Sharing sharing, const RayMatch* rays, Frame* frame) {
  *frame = Frame();
  const SharingCase& sharingCase = caseOf(sharing);
  if (sharingCase.firstGroup > 0)
    frame->origin = rays[kRays - 1].centre;
  else if (!closestPoint(rays, &frame->origin))
    return false;
  double meanRadius = 0, meanDistance = 0;
  for (int j = 0; j < kRays; ++j) meanRadius += std::hypot(rays[j].u, rays[j].v) / kRays;
  for (int j = 0; j < sharingCase.unshared(); ++j)
    meanDistance += rays[j].direction.cross(rays[j].centre - frame->origin).norm() / sharingCase.unshared();
  frame->imageScale = 4 * meanRadius;
  frame->length = meanDistance;
  if (sharingCase.secondGroup > 0) {
    const Vector3d toSecond = rays[sharingCase.unshared()].centre - frame->origin;
    frame->length = toSecond.norm() / kSecondCentre;
    frame->turn = Frame::turnToThirdAxis(toSecond.normalized());
  }
  const auto isScale = [](double scale) { return scale > 0 && std::isfinite(scale); };
  return isScale(frame->imageScale) && isScale(frame->length);
}

Parameters parametersIn(const Frame& frame, Sharing sharing, const RayMatch* rays) {
  const SharingCase& sharingCase = caseOf(sharing);
  Parameters p;
  for (int j = 0; j < kRays; ++j) {
    Vector3d centre = frame.turn * (rays[j].centre - frame.origin) / frame.length;
    if (sharingCase.isOfFirst(j)) centre = Vector3d::Zero();
    if (sharingCase.isOfSecond(j)) centre = Vector3d(0, 0, kSecondCentre);
    complex_rays::setRay(frame, rays[j], centre, j, &p);
  }
  return p;
}

Parameters alignWith(const StartSystem& start, const RayMatch* rays, Frame* frame) {
  complex_rays::Alignment alignment;
  alignment.addRays(start.parameters, parametersIn(*frame, start.sharing, rays));
  alignment.apply(caseOf(start.sharing).secondGroup > 0, frame);
  Parameters target = parametersIn(*frame, start.sharing, rays);
  complex_rays::scaleRaysLike(start.parameters, &target);
  return target;
}

Solution solutionOf(const FocalPose& pose, const Frame& frame) {
  const complex_rays::Orientation orientation = complex_rays::orientationOf(pose, frame);
  const Number alpha = std::conj(orientation.beta);
  const Vector3d t = pose.rotation.transpose() * (frame.origin - pose.position) / frame.length;
  const Number tau = Number(t[0], t[1]) * frame.phase * frame.imageScale / (pose.focalLength * alpha);
  return {orientation.x, std::conj(orientation.x), std::conj(tau), tau, t[2], alpha, orientation.beta};
}

FocalPose poseOf(const Solution& solution, const Frame& frame) {
  const complex_rays::Orientation orientation =
      complex_rays::realOrientation(solution.x, solution.y, solution.alpha, solution.beta);
  FocalPose pose;
  complex_rays::setOrientation(orientation, frame, &pose);
  const Number tau = (solution.tau + std::conj(solution.tauBar)) / 2.0;
  const Number t = pose.focalLength / frame.imageScale * std::conj(orientation.beta) * tau * std::conj(frame.phase);
  pose.position = frame.origin - frame.length * (pose.rotation * Vector3d(t.real(), t.imag(), solution.t3.real()));
  return pose;
}

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
