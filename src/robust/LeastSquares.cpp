#include "robust/LeastSquares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "correspondences/arrayParts.hpp"
#include "robust/FixedSize.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::kPoseParameters;

template <int N>
using Vector = Eigen::Matrix<double, N, 1>;
template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

// The cost at a pose, with its derivatives by the N parameters that are estimated.
template <int N>
struct Linearization {
  double cost = 0;
  Vector<N> gradient;
  Matrix<N> hessian;
  bool isFinite() const { return std::isfinite(cost) && gradient.allFinite() && hessian.allFinite(); }
};

// Where the kernels have the derivatives by an estimated parameter: they derive by log f also if it is known.
int kernelParameter(Intrinsics estimated, int parameter) {
  return parameter < kPoseParameters || estimated.focalLength ? parameter : parameter + 1;
}

// Sums over many correspondences are those of parts, which are the same for any number of threads.
constexpr std::size_t kLeastPart = 256;
static_assert(kLeastPart % correspondences::kPadding == 0, "a part begins where the kernels may begin");

std::size_t numberOfParts(bool takePart, std::size_t size) {
  const std::size_t length = partLength(size, kLeastPart);
  return takePart && size > 0 ? (size + length - 1) / length : 0;
}

template <class Arrays>
Arrays partAt(const Arrays& arrays, std::size_t number) {
  const std::size_t length = partLength(arrays.size, kLeastPart);
  return correspondences::part(arrays, number * length, std::min((number + 1) * length, arrays.size));
}

NormalEquations sumOfParts(const LeastSquaresProblem& problem, const PlainPose& pose, std::size_t ofPoints, std::size_t ofRays) {
  std::vector<NormalEquations> parts(ofPoints + ofRays);
  const auto addPart = [&](std::size_t number) {
    if (number < ofPoints)
      problem.kernels->addPoints(partAt(problem.points, number), pose, problem.pointLoss, parts[number]);
    else
      problem.kernels->addRays(partAt(problem.rays, number - ofPoints), pose, problem.rayLoss, parts[number]);
  };
  forAll(problem.workers, parts.size(), addPart);
  NormalEquations sums;
  for (const NormalEquations& part : parts) add(part, sums);
  return sums;
}

NormalEquations normalEquations(const LeastSquaresProblem& problem, const QueryPose& pose) {
  const PlainPose plain = toPlain(pose);
  const std::size_t ofPoints = numberOfParts(problem.kinds.points, problem.points.size);
  const std::size_t ofRays = numberOfParts(problem.kinds.rays, problem.rays.size);
  if (ofPoints > 1 || ofRays > 1) return sumOfParts(problem, plain, ofPoints, ofRays);
  NormalEquations sums;
  if (problem.kinds.points) problem.kernels->addPoints(problem.points, plain, problem.pointLoss, sums);
  if (problem.kinds.rays) problem.kernels->addRays(problem.rays, plain, problem.rayLoss, sums);
  return sums;
}

// The distortion is the last parameter.
template <int N>
void addPrior(const DistortionPrior& prior, double distortion, Linearization<N>& sums) {
  const double weight = prior.weight(distortion);
  sums.cost += prior.cost(distortion);
  sums.gradient[N - 1] += weight * distortion;
  sums.hessian(N - 1, N - 1) += weight;
}

// The focal length comes behind the pose.
template <int N>
void addPrior(const FocalLengthPrior& prior, double focalLength, Linearization<N>& sums) {
  const double weight = prior.weight(focalLength);
  sums.cost += prior.cost(focalLength);
  sums.gradient[kPoseParameters] += weight * prior.logDifference(focalLength);
  sums.hessian(kPoseParameters, kPoseParameters) += weight;
}

template <int N>
Linearization<N> linearize(const LeastSquaresProblem& problem, const QueryPose& pose) {
  const NormalEquations sums = normalEquations(problem, pose);
  Linearization<N> result;
  result.cost = sums.cost;
  for (int row = 0; row < N; ++row) {
    const int from = kernelParameter(problem.estimated, row);
    result.gradient[row] = sums.gradient[from];
    for (int column = row; column < N; ++column) {
      const double entry = sums.hessian[from][kernelParameter(problem.estimated, column)];
      result.hessian(row, column) = entry;
      result.hessian(column, row) = entry;
    }
  }
  if (N > kPoseParameters && problem.estimated.radial) addPrior<N>(problem.distortionPrior, pose.distortion, result);
  if constexpr (N > kPoseParameters)
    if (problem.estimated.focalLength) addPrior<N>(problem.focalLengthPrior, pose.focalLength, result);
  return result;
}

// exp([v]x)
Eigen::Matrix3d rotationOf(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, v / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
}

void orthonormalize(Eigen::Matrix3d& rotation) {
  rotation.col(0).normalize();
  rotation.col(1) = (rotation.col(1) - rotation.col(0).dot(rotation.col(1)) * rotation.col(0)).normalized();
  rotation.col(2) = rotation.col(0).cross(rotation.col(1));
}

double movedFocalLength(double focalLength, double logStep, const LeastSquaresOptions& options) {
  const double least = std::max(options.minFocalLength, std::numeric_limits<double>::min());  // positive also after rounding
  return std::clamp(focalLength * std::exp(logStep), least, options.maxFocalLength);
}

template <int N>
QueryPose moved(const QueryPose& pose, const Vector<N>& step, Intrinsics estimated, const LeastSquaresOptions& options) {
  QueryPose result = pose;
  result.rotation = pose.rotation * rotationOf(step.template head<3>());
  orthonormalize(result.rotation);
  result.position += step.template segment<3>(3);
  if constexpr (N > kPoseParameters) {
    if (estimated.focalLength) result.focalLength = movedFocalLength(pose.focalLength, step[kPoseParameters], options);
    if (estimated.radial)
      result.distortion = std::clamp(pose.distortion + step[N - 1], options.minDistortion, options.maxDistortion);
  }
  return result;
}

// Solves (hessian + damping diag(hessian)) step = -gradient, in units in which the diagonal is 1. A parameter without influence
// stays.
template <int N>
Vector<N> dampedStep(const Linearization<N>& at, double damping) {
  const Vector<N> scale = at.hessian.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.; });
  Matrix<N> matrix = scale.asDiagonal() * at.hessian * scale.asDiagonal();
  matrix.diagonal().setConstant(1 + damping);
  return -scale.cwiseProduct(matrix.llt().solve(scale.cwiseProduct(at.gradient)));
}

// So that the derivatives hold where it leads: along what the data hardly fix, a step can be as long as it likes.
template <int N>
bool isShort(const Vector<N>& step) {
  constexpr double kShort = 0.1;  // of rotation, position (in the frame's unit) and log f
  return step.template head<std::min(N, correspondences::kFocalPoseParameters)>().cwiseAbs().maxCoeff() < kShort;
}

template <int N>
LeastSquaresResult minimizeFixed(const LeastSquaresProblem& problem, const QueryPose& start, const LeastSquaresOptions& options) {
  constexpr double kMaxDamping = 1e10, kMinDamping = 1e-12;
  LeastSquaresResult result;
  result.pose = start;
  Linearization<N> current = linearize<N>(problem, start);
  if (!current.isFinite()) {
    result.cost = std::numeric_limits<double>::infinity();
    result.information = Matrix<N>::Zero();
    return result;
  }
  double damping = 1e-4;
  while (!result.converged && result.iterations < options.maxIterations) {
    ++result.iterations;
    const Vector<N> step = dampedStep(current, damping);
    const QueryPose candidate = moved<N>(result.pose, step, problem.estimated, options);
    const bool changesLittle = -current.gradient.dot(step) <= options.minRelativeDecrease * current.cost;
    if (changesLittle && isShort<N>(step)) {  // nobody needs to look where it leads
      result.pose = candidate;
      result.converged = true;
      break;
    }
    const Linearization<N> next = linearize<N>(problem, candidate);
    if (next.cost < current.cost && next.isFinite()) {
      result.converged = current.cost - next.cost <= options.minRelativeDecrease * current.cost;
      result.pose = candidate;
      current = next;
      damping = std::max(damping / 10, kMinDamping);
    } else {
      result.converged = damping >= kMaxDamping || changesLittle;
      damping *= 10;
    }
  }
  result.cost = current.cost;
  result.information = current.hessian;
  return result;
}

}  // namespace

void add(const NormalEquations& part, NormalEquations& sums) {
  sums.cost += part.cost;
  for (int row = 0; row < kMostParameters; ++row) {
    sums.gradient[row] += part.gradient[row];
    for (int column = row; column < kMostParameters; ++column) sums.hessian[row][column] += part.hessian[row][column];
  }
}

double DistortionPrior::cost(double distortion) const {
  return scale > 0 ? factor * 2 * std::log1p(distortion * distortion / (scale * scale)) : 0;
}

double DistortionPrior::weight(double distortion) const {
  return scale > 0 ? factor * 2 / (scale * scale + distortion * distortion) : 0;
}

LeastSquaresProblem makeProblem(const CorrespondenceArrays& arrays, const KindLoss& pointLoss, const KindLoss& rayLoss,
                                Intrinsics estimated) {
  const CameraModel pinhole = estimated.focalLength ? CameraModel::Pinhole : CameraModel::CalibratedPinhole;
  const CameraModel model = estimated.radial ? CameraModel::Radial : pinhole;
  return {&kernels(model), arrays.pointArrays(), arrays.rayArrays(), pointLoss, rayLoss, kBothKinds, estimated, {}};
}

LeastSquaresProblem withoutRays(LeastSquaresProblem problem) {
  problem.kinds.rays = false;
  return problem;
}

LeastSquaresResult minimize(const LeastSquaresProblem& problem, const QueryPose& start, const LeastSquaresOptions& options) {
  return withFixedSize(problem.estimated.parameters(),
                       [&](auto size) { return minimizeFixed<decltype(size)::value>(problem, start, options); });
}

Derivatives derivatives(const LeastSquaresProblem& problem, const QueryPose& pose) {
  return withFixedSize(problem.estimated.parameters(), [&](auto size) {
    const auto at = linearize<decltype(size)::value>(problem, pose);
    return Derivatives{at.gradient, at.hessian};
  });
}

ParameterMatrix information(const LeastSquaresProblem& problem, const QueryPose& pose) {
  return derivatives(problem, pose).information;
}

ParameterPair gradientByImageShift(const LeastSquaresProblem& problem, const QueryPose& pose) {
  const PlainPose plain = toPlain(pose);
  ImageShiftSums sums;
  if (problem.kinds.points) problem.kernels->addPointShifts(problem.points, plain, problem.pointLoss, sums);
  if (problem.kinds.rays) problem.kernels->addRayShifts(problem.rays, plain, problem.rayLoss, sums);
  ParameterPair result(problem.estimated.parameters(), 2);
  for (int row = 0; row < problem.estimated.parameters(); ++row) {
    const int from = kernelParameter(problem.estimated, row);
    result(row, 0) = sums.alongU[from];
    result(row, 1) = sums.alongV[from];
  }
  return result;
}

ParameterMatrix estimatedPart(const NormalEquations& sums, Intrinsics estimated) {
  const int size = estimated.parameters();
  ParameterMatrix result(size, size);
  for (int row = 0; row < size; ++row)
    for (int column = row; column < size; ++column)
      result(row, column) = result(column, row) =
          sums.hessian[kernelParameter(estimated, row)][kernelParameter(estimated, column)];
  return result;
}

ParameterMatrix estimatedPart(const FullParameterMatrix& sums, Intrinsics estimated) {
  const int size = estimated.parameters();
  ParameterMatrix result(size, size);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      result(row, column) = sums(kernelParameter(estimated, row), kernelParameter(estimated, column));
  return result;
}

ParameterVector estimatedGradient(const NormalEquations& sums, Intrinsics estimated) {
  ParameterVector result(estimated.parameters());
  for (int k = 0; k < estimated.parameters(); ++k) result[k] = sums.gradient[kernelParameter(estimated, k)];
  return result;
}

ParameterVector changeOf(const QueryPose& from, const QueryPose& to, Intrinsics estimated) {
  const Eigen::AngleAxisd rotation(Eigen::Matrix3d(from.rotation.transpose() * to.rotation));
  ParameterVector result(estimated.parameters());
  result.head<3>() = rotation.angle() * rotation.axis();
  result.segment<3>(3) = to.position - from.position;
  if (estimated.focalLength) result[kPoseParameters] = std::log(to.focalLength / from.focalLength);
  if (estimated.radial) result[estimated.parameters() - 1] = to.distortion - from.distortion;
  return result;
}

ParameterMatrix byKernelParameters(const ParameterMatrix& matrix, Intrinsics estimated) {
  ParameterMatrix result = ParameterMatrix::Zero(kMostParameters, kMostParameters);
  for (int row = 0; row < matrix.rows(); ++row)
    for (int column = 0; column < matrix.cols(); ++column)
      result(kernelParameter(estimated, row), kernelParameter(estimated, column)) = matrix(row, column);
  return result;
}

}  // namespace robust
}  // namespace hybridgv
