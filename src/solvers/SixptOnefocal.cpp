// Six rays from one centre c: pose up to the length of the baseline, which is returned as 1.
#include <Eigen/Core>

#include "solvers/OneFocalFundamental.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace solvers {
namespace {

bool allInFront(const SixCorrespondences& six, double f, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& rigCentre) {
  for (int k = 0; k < kSix; ++k)
    if (!meetInFront(six.u[k], six.v[k], f, rotation * six.direction[k], rigCentre)) return false;
  return true;
}

}  // namespace

int sixptOnefocal(const RayMatch* rays, const PointMatch* /*points*/, FocalPose* solutions) {
  SixCorrespondences six;
  for (int k = 0; k < kSix; ++k) six.u[k] = rays[k].u, six.v[k] = rays[k].v, six.direction[k] = rays[k].direction;
  if (!six.normalise()) return 0;
  OneFocalMotion motions[kMaxOneFocalMotions];
  const int found = oneFocalFundamental(six, motions);
  int count = 0;
  for (int i = 0; i < found; ++i) {
    const OneFocalMotion& motion = motions[i];
    // Of the two rotations and the two signs of the baseline, at most one puts all points in front of both cameras.
    const Eigen::Matrix3d rotations[] = {motion.rotation, motion.otherRotation()};
    for (int choice = 0; choice < 4; ++choice) {
      const Eigen::Matrix3d& rotation = rotations[choice / 2];
      const double sign = choice % 2 ? -1 : 1;
      if (!allInFront(six, motion.focalLength, rotation, sign * motion.baselineInQuery)) continue;
      solutions[count].rotation = rotation.transpose();
      solutions[count].position = rays[0].centre - sign * motion.baseline;
      solutions[count].focalLength = motion.focalLength * six.imageScale;
      ++count;
      break;
    }
  }
  return count;
}

}  // namespace solvers
}  // namespace hybridgv
