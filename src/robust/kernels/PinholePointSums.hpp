// The sums of the normal equations of 2D-3D correspondences in a pinhole image.
#pragma once

#include "robust/kernels/NormalEquationsSum.hpp"
#include "robust/kernels/Reprojection.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// With y = R^T (X - p), m = (y_x, y_y) / y_z, s = f / y_z, and the position's derivatives in the query's frame at first, the
// derivatives of u and v by rotation, position and log f are
//
//     ( u m_v       -f - u m_u   v  |  -s   0   s m_u  |  u )
//     ( f + v m_v   -u m_v      -u  |   0  -s   s m_v  |  v ) ,
//
// because v m_u = u m_v. Many entries of J^T W J are 0, equal or opposite, which leaves 20 sums instead of 28.
class PinholePointSums {
 public:
  HYBRIDGV_INLINE void add(const Reprojection& point, Doubles inverseFocal, const Pose& pose, Doubles w) {
    const Doubles u = point.projectedU, v = point.projectedV, s = point.scale, errorU = point.errorU, errorV = point.errorV;
    const Doubles mu = u * inverseFocal, mv = v * inverseFocal, uv = u * mv, uu = -pose.f - u * mu, vv = pose.f + v * mv;
    const Doubles wu = w * u, wv = w * v, wuv = w * uv, wuu = w * uu, wvv = w * vv, ws = w * s;
    const Doubles radius = wu * u + wv * v, z = s * inverseFocal;  // 1 / y_z
    const Doubles turn0 = wuv * u + wvv * v, turn1 = wuu * u - wuv * v;
    turns_[0] += wuv * uv + wvv * vv;
    turns_[1] += wuv * (uu - vv);
    turns_[2] += wuu * uu + wuv * uv;
    roll_[0] += wuv * v - wvv * u;
    roll_[1] += wuu * v + wuv * u;
    shifts_[0] += ws * uv;
    shifts_[1] += ws * vv;
    shifts_[2] += ws * uu;
    depths_[0] += turn0 * z;
    depths_[1] += turn1 * z;
    zooms_[0] += turn0;
    zooms_[1] += turn1;
    positions_[0] += ws * s;
    positions_[1] += ws * s * mu;
    positions_[2] += ws * s * mv;
    images_[0] += ws * u;
    images_[1] += ws * v;
    radii_[0] += radius;
    radii_[1] += radius * z;
    radii_[2] += radius * z * z;
    gradient_[0] += wuv * errorU + wvv * errorV;
    gradient_[1] += wuu * errorU - wuv * errorV;
    gradient_[2] += wv * errorU - wu * errorV;
    gradient_[3] -= ws * errorU;
    gradient_[4] -= ws * errorV;
    const Doubles zoom = wu * errorU + wv * errorV;
    gradient_[5] += zoom * z;
    gradient_[6] += zoom;
  }

  void addTo(const PlainPose& pose, NormalEquations& total) const {
    double hessian[kParameters][kParameters] = {}, gradient[kParameters] = {};
    for (int i = 0; i < kParameters; ++i) gradient[i] = sum(gradient_[i]);
    const double uv = sum(shifts_[0]), u = sum(images_[0]), v = sum(images_[1]);
    hessian[0][0] = sum(turns_[0]);
    hessian[0][1] = sum(turns_[1]);
    hessian[1][1] = sum(turns_[2]);
    hessian[0][2] = sum(roll_[0]);
    hessian[1][2] = sum(roll_[1]);
    hessian[0][3] = -uv;
    hessian[0][4] = -sum(shifts_[1]);
    hessian[1][3] = -sum(shifts_[2]);
    hessian[1][4] = uv;
    hessian[2][3] = -v;
    hessian[2][4] = u;
    hessian[3][6] = -u;
    hessian[4][6] = -v;
    hessian[0][5] = sum(depths_[0]);
    hessian[1][5] = sum(depths_[1]);
    hessian[0][6] = sum(zooms_[0]);
    hessian[1][6] = sum(zooms_[1]);
    hessian[3][3] = sum(positions_[0]);
    hessian[4][4] = hessian[3][3];
    hessian[3][5] = -sum(positions_[1]);
    hessian[4][5] = -sum(positions_[2]);
    hessian[2][2] = sum(radii_[0]);
    hessian[6][6] = hessian[2][2];
    hessian[5][6] = sum(radii_[1]);
    hessian[5][5] = sum(radii_[2]);
    addTurned(pose, gradient, hessian, total);
  }

 private:
  static constexpr int kParameters = correspondences::kFocalPoseParameters;

  // Rotation by rotation about the image's axes and about the optical axis, by shifts in the image plane and in depth, by log f;
  // position by position in the image plane and by the rest; and what is a sum over u^2 + v^2.
  Doubles turns_[3] = {}, roll_[2] = {}, shifts_[3] = {}, depths_[2] = {}, zooms_[2] = {}, positions_[3] = {}, images_[2] = {},
          radii_[3] = {};
  Doubles gradient_[kParameters] = {};
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
