// The loops over all correspondences: errors of a pose, its score, its normal equations. Plain data only, no Eigen type: these
// functions exist once per instruction set and are chosen at run time.
#pragma once

#include <cstddef>

#include "correspondences/ArrayViews.hpp"
#include "correspondences/Intrinsics.hpp"
#include "math/simd/SimdLevel.hpp"

namespace hybridgv {
namespace robust {

using correspondences::PointArrays;
using correspondences::RayArrays;

// A pose as the kernels read it: the columns r1, r2, r3 of the rotation (query -> rig), the position, the focal length, and the
// distortion (QueryPose), which those for pinhole images take as 0.
struct PlainPose {
  double r1[3], r2[3], r3[3];
  double position[3];
  double focalLength;
  double distortion;
};

struct Score {
  double msac = 0;  // sum of max(0, 1 - (error / threshold)^2)
  int inliers = 0;  // number of errors below the threshold
};

// With x = (error / scale)^2, a correspondence costs scale^2 rho(x):
enum class Loss {
  Quadratic,  // rho = x; rays are not required to meet in front of the cameras
  Truncated,  // rho = min(x, 1)
  Mixture,    // rho = log((1 + a) / (1 + a / (1 + x)^8)), a = odds: see ErrorMixture
};

// How one kind of correspondence enters a robust least-squares problem: the sum of precision * scale^2 rho(x) is minimized.
struct KindLoss {
  Loss loss = Loss::Quadratic;
  double scale = 1;      // [px]
  double precision = 1;  // [1/px^2]
  double odds = 1;       // of Loss::Mixture, at most 1e9
  // Whether a ray may meet its viewing ray beyond infinity, behind both cameras: see BeyondInfinity. Not for Loss::Quadratic.
  bool reachesBeyondInfinity = false;
};

// The parameters by which the kernels derive are a small rotation in the query's frame (R -> R exp([.]x)), the position, log f,
// and the distortion, which those for pinhole images do not have; those for calibrated ones do not derive rays by log f. Which of them
// are estimated, LeastSquares decides.
using correspondences::kMostParameters;

// For residuals e with derivatives J and weights W (precision times the derivative of rho), the sums J^T W e and J^T W J.
struct NormalEquations {
  double cost = 0;
  double gradient[kMostParameters] = {};
  double hessian[kMostParameters][kMostParameters] = {};  // the upper triangle
};

// The sums J^T W d, d the derivatives of the errors by a shift of all image points along u and along v.
struct ImageShiftSums {
  double alongU[kMostParameters] = {}, alongV[kMostParameters] = {};
};

constexpr std::size_t kRayRow = 1 + kMostParameters + 3, kPointRow = 1 + 2 * kMostParameters + 2;

// Thresholds T, T/2, T/4, ..
constexpr int kLevels = 7;

// One instruction set's versions. Ranges [begin, end) begin at a multiple of correspondences::kPadding and end at one or at the arrays' size.
struct Kernels {
  // Squared errors; infinite as reprojectionError and sampsonError are. `errors` has room for the padding.
  void (*squaredPointErrors)(const PointArrays&, const PlainPose&, double* errors);
  void (*squaredRayErrors)(const RayArrays&, const PlainPose&, double* errors);
  // The same, finite also beyond infinity (BeyondInfinity).
  void (*squaredRayErrorsBeyondInfinity)(const RayArrays&, const PlainPose&, double* errors);
  Score (*scorePoints)(const PointArrays&, const PlainPose&, double squaredThreshold, std::size_t begin, std::size_t end);
  Score (*scoreRays)(const RayArrays&, const PlainPose&, double squaredThreshold, std::size_t begin, std::size_t end);
  // Add to the sums. A point that is not in front of the query costs rho(infinity), as does a ray but for Loss::Quadratic.
  void (*addPoints)(const PointArrays&, const PlainPose&, const KindLoss&, NormalEquations&);
  void (*addRays)(const RayArrays&, const PlainPose&, const KindLoss&, NormalEquations&);
  // The same weights and derivatives with what the errors change by, for the errors.
  void (*addPointShifts)(const PointArrays&, const PlainPose&, const KindLoss&, ImageShiftSums&);
  void (*addRayShifts)(const RayArrays&, const PlainPose&, const KindLoss&, ImageShiftSums&);
  // W J C J^T of every ray, C a symmetric matrix of kMostParameters rows. `leverages` has room for the padding.
  void (*rayLeverages)(const RayArrays&, const PlainPose&, const KindLoss&, const double* covariance, double* leverages);
  // The weights, errors and derivatives of every correspondence, as columns of the padded size: kRayRow of rays, namely the weight W, the
  // derivatives of the error by the parameters and by the image point (u, v), and the error; kPointRow of points, namely the weight, the
  // derivatives of the error along u by the parameters, those of the error along v, and both errors. Where the weight is 0 the others
  // need not be finite.
  void (*rayRows)(const RayArrays&, const PlainPose&, const KindLoss&, double* columns);
  void (*pointRows)(const PointArrays&, const PlainPose&, const KindLoss&, double* columns);
  // How many squared errors are below the square of each threshold; `squaredThreshold`: T^2. No padding is needed.
  void (*countLevels)(const double* squaredErrors, std::size_t size, double squaredThreshold, int counts[kLevels]);
};

enum class CameraModel { Pinhole, CalibratedPinhole, Radial };

// `level` must be supported by the processor.
const Kernels& kernels(math::SimdLevel level, CameraModel model = CameraModel::Pinhole);
// The best ones (see simdLevel).
const Kernels& kernels(CameraModel model = CameraModel::Pinhole);
// The best ones for errors at this pose: without distortion, those for pinhole images do, and take less time.
const Kernels& kernelsFor(const PlainPose& pose);

}  // namespace robust
}  // namespace hybridgv
