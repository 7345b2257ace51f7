#include "robust/kernels/Kernels.hpp"
#include "robust/toPlain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "HybridScene.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "correspondences/PaddedValues.hpp"
#include "hybridgv/distortion.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"
#include "movedPose.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using math::SimdLevel;
using test::kDistortionUnit;
using test::moved;
using test::unitOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<SimdLevel> levels() {
  std::vector<SimdLevel> result;
  for (const SimdLevel level : {SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512})
    if (level <= math::supportedSimdLevel()) result.push_back(level);
  return result;
}

// A camera model with distortions [1/px^2] for it: image points are up to about 700 px from the principal point.
struct Model {
  CameraModel model;
  std::vector<double> distortions;
};
const std::vector<Model>& models() {
  static const std::vector<Model> result = {
      {CameraModel::Pinhole, {0}}, {CameraModel::CalibratedPinhole, {0}}, {CameraModel::Radial, {-7e-7, -1e-7, 0, 3e-7}}};
  return result;
}
QueryPose withDistortion(const FocalPose& pose, double distortion) {
  QueryPose result = pose;
  result.distortion = distortion;
  return result;
}

// Sizes that are and are not multiples of the vectors' lengths; half of the rig cameras have a known focal length.
struct Data {
  Data(test::Random& random, int rays, int points) : adapter(make(random, rays, points)), arrays(read(adapter)) {}

  NoncentralHybridAdapter make(test::Random& random, int rays, int points) {
    test::SceneOptions options;
    options.rays = rays;
    options.points = points;
    options.imageNoise = 2;
    options.outlierShareRays = options.outlierSharePoints = 0.4;
    scene = test::makeHybridScene(random, options);
    NoncentralHybridAdapter result = scene.adapter();
    result.setRigFocalLengths({0, 1000, 0, 800, 2000});
    // Some near truth, some far from it, some that look away.
    for (int i = 0; i < 4; ++i) poses.push_back(test::perturbed(random, scene.truth, 0.02, 0.2, 0.05));
    for (int i = 0; i < 4; ++i) poses.push_back(test::perturbed(random, scene.truth, 3, 10, 1));
    return result;
  }
  static correspondences::CorrespondenceArrays read(const NoncentralHybridAdapter& adapter) {
    return {adapter, correspondences::allIndices(adapter.getNumberCorrespondences2d2d()),
            correspondences::allIndices(adapter.getNumberCorrespondences2d3d())};
  }
  QueryPose normalized(const QueryPose& pose) const {
    QueryPose result = pose;
    result.position = arrays.normalization().apply(pose.position);
    return result;
  }
  PlainPose plain(const QueryPose& pose) const { return toPlain(normalized(pose)); }
  double reprojection(const QueryPose& pose, std::size_t i) const {
    return hybrid_pose::reprojectionError(pose, pose.distortion, adapter.getImagePoint2d3d(i), adapter.getPoint(i));
  }
  double sampson(const QueryPose& pose, std::size_t i) const {
    return hybrid_pose::sampsonError(pose, pose.distortion, adapter.getImagePoint2d2d(i), adapter.getBearingVector(i),
                                     adapter.getCamOffset(i), adapter.getCamRotation(i), adapter.getRigFocalLength(i));
  }

  test::HybridScene scene;
  std::vector<FocalPose> poses;
  NoncentralHybridAdapter adapter;
  correspondences::CorrespondenceArrays arrays;
};

void expectEqualErrors(double squared, double error) {
  if (std::isinf(error)) {
    EXPECT_EQ(squared, kInfinity);
  } else
    EXPECT_NEAR(std::sqrt(squared), error, 1e-7 * (1 + error));
}

TEST(Kernels, ErrorsAreThoseOfTheDefinitionsAtEveryLevel) {
  test::Random random(test::testSeed(), 10);
  for (const int size : {0, 1, 7, 8, 61}) {
    const Data data(random, size, size + 2);
    std::vector<double> errors(100);
    for (const SimdLevel level : levels())
      for (const Model& model : models())
        for (const double distortion : model.distortions)
          for (const FocalPose& focalPose : data.poses) {
            const Kernels& tested = kernels(level, model.model);
            const QueryPose pose = withDistortion(focalPose, distortion);
            tested.squaredPointErrors(data.arrays.pointArrays(), data.plain(pose), errors.data());
            for (std::size_t i = 0; i < data.scene.points.size(); ++i) expectEqualErrors(errors[i], data.reprojection(pose, i));
            tested.squaredRayErrors(data.arrays.rayArrays(), data.plain(pose), errors.data());
            for (std::size_t i = 0; i < data.scene.bearings.size(); ++i) expectEqualErrors(errors[i], data.sampson(pose, i));
          }
  }
}

Score expectedScore(const std::vector<double>& errors, std::size_t begin, std::size_t end, double threshold) {
  Score score;
  for (std::size_t i = begin; i < end; ++i)
    if (errors[i] < threshold) {
      score.msac += 1 - std::pow(errors[i] / threshold, 2);
      ++score.inliers;
    }
  return score;
}

TEST(Kernels, ScoresAreTheSumsOverTheInliersAtEveryLevel) {
  test::Random random(test::testSeed(), 11);
  const double threshold = 9;
  for (const int size : {1, 8, 61}) {
    const Data data(random, size, size + 2);
    for (std::size_t k = 0; k < 2 * data.poses.size(); ++k) {
      const QueryPose pose = withDistortion(data.poses[k / 2], k % 2 == 0 ? 0 : -4e-7);
      const CameraModel model = k % 2 == 0 ? CameraModel::Pinhole : CameraModel::Radial;
      std::vector<double> reprojection, sampson;
      for (std::size_t i = 0; i < data.scene.points.size(); ++i) reprojection.push_back(data.reprojection(pose, i));
      for (std::size_t i = 0; i < data.scene.bearings.size(); ++i) sampson.push_back(data.sampson(pose, i));
      for (const SimdLevel level : levels())
        for (const std::size_t begin : {std::size_t{0}, std::size_t{8}}) {
          if (begin >= sampson.size()) continue;
          const Score points =
              kernels(level, model)
                  .scorePoints(data.arrays.pointArrays(), data.plain(pose), threshold * threshold, begin, reprojection.size());
          const Score expectedPoints = expectedScore(reprojection, begin, reprojection.size(), threshold);
          EXPECT_EQ(points.inliers, expectedPoints.inliers);
          EXPECT_NEAR(points.msac, expectedPoints.msac, 1e-8 * (1 + points.msac));
          const Score rays =
              kernels(level, model)
                  .scoreRays(data.arrays.rayArrays(), data.plain(pose), threshold * threshold, begin, sampson.size());
          const Score expectedRays = expectedScore(sampson, begin, sampson.size(), threshold);
          EXPECT_EQ(rays.inliers, expectedRays.inliers);
          EXPECT_NEAR(rays.msac, expectedRays.msac, 1e-8 * (1 + rays.msac));
        }
    }
  }
}

TEST(Kernels, APoseThatIsNotANumberHasNoInliers) {
  test::Random random(test::testSeed(), 12);
  const Data data(random, 20, 20);
  FocalPose pose = data.scene.truth;
  pose.position[1] = NAN;
  for (const SimdLevel level : levels()) {
    EXPECT_EQ(kernels(level).scorePoints(data.arrays.pointArrays(), toPlain(pose), 100, 0, 20).inliers, 0);
    EXPECT_EQ(kernels(level).scoreRays(data.arrays.rayArrays(), toPlain(pose), 100, 0, 20).msac, 0);
  }
}

// ---- normal equations ----

constexpr Loss kLosses[] = {Loss::Quadratic, Loss::Truncated, Loss::Mixture};

int parametersOf(CameraModel model) {
  switch (model) {
    case CameraModel::Pinhole:
      return correspondences::kFocalPoseParameters;
    case CameraModel::CalibratedPinhole:
      return correspondences::kPoseParameters;
    case CameraModel::Radial:
      break;
  }
  return kMostParameters;
}

NormalEquations sums(const Kernels& tested, const Data& data, const QueryPose& normalized, const KindLoss& loss, bool points,
                     bool rays, correspondences::PaddedPointer narrowing = {}) {
  NormalEquations result;
  if (points) tested.addPoints(data.arrays.pointArrays(), toPlain(normalized), loss, result);
  RayArrays rayArrays = data.arrays.rayArrays();
  rayArrays.narrowing = narrowing;
  if (rays) tested.addRays(rayArrays, toPlain(normalized), loss, result);
  return result;
}

// gradient = J^T W e is half the derivative of the cost.
void expectGradientIsTheDifference(const Kernels& tested, int parameters, const Data& data, const QueryPose& pose,
                                   const KindLoss& loss, bool points, correspondences::PaddedPointer narrowing = {}) {
  const auto at = [&](const QueryPose& p) { return sums(tested, data, p, loss, points, !points, narrowing); };
  const NormalEquations here = at(pose);
  if (!std::isfinite(here.cost)) return;  // something is behind a camera
  const double h = 1e-6;
  for (int i = 0; i < parameters; ++i) {
    const double forward = (at(moved(pose, i, h)).cost - here.cost) / h;
    const double backward = (here.cost - at(moved(pose, i, -h)).cost) / h, difference = (forward + backward) / 2;
    // Where an error passes the truncation, the cost has a kink, and the difference says nothing.
    if (loss.loss == Loss::Truncated && std::abs(forward - backward) > 1e-3 * std::abs(difference)) continue;
    EXPECT_NEAR(2 * unitOf(i) * here.gradient[i], difference, 1e-5 * (1 + std::abs(difference)) + 1e-13 * here.cost / h)
        << "loss " << static_cast<int>(loss.loss) << " points " << points << " parameter " << i << " distortion "
        << pose.distortion;
  }
}

double expectedCost(double error, const KindLoss& loss, double narrowing = 1) {
  const double x = narrowing * error * error / (loss.scale * loss.scale);
  const double mixture = std::log((1 + loss.odds) / (1 + loss.odds * std::pow(1 + x, -8)));
  const double rho = loss.loss == Loss::Quadratic ? x : loss.loss == Loss::Truncated ? std::min(x, 1.) : mixture;
  return loss.precision * loss.scale * loss.scale * rho / narrowing;
}

TEST(Kernels, CostsAreThoseOfTheLossAtEveryLevel) {
  test::Random random(test::testSeed(), 13);
  const Data data(random, 61, 63);
  const FocalPose& pose = data.poses[0];  // all points in front
  for (const Loss loss : {Loss::Truncated, Loss::Mixture})
    for (const SimdLevel level : levels()) {
      const KindLoss spec{loss, 1000, 0.25, 1e9};  // wide: no error is infinite
      double points = 0, rays = 0;
      for (std::size_t i = 0; i < data.scene.points.size(); ++i) points += expectedCost(data.reprojection(pose, i), spec);
      const QueryPose normalized = data.normalized(pose);
      EXPECT_NEAR(sums(kernels(level), data, normalized, spec, true, false).cost, points, 1e-8 * points);
      for (std::size_t i = 0; i < data.scene.bearings.size(); ++i) rays += expectedCost(data.sampson(pose, i), spec);
      EXPECT_NEAR(sums(kernels(level), data, normalized, spec, false, true).cost, rays, 1e-8 * rays);
    }
}

TEST(Kernels, GradientsAreTheCentralDifferencesOfTheCostAtEveryLevel) {
  test::Random random(test::testSeed(), 14);
  const Data data(random, 61, 63);
  for (const Loss loss : kLosses)
    for (const bool points : {true, false})
      for (const SimdLevel level : levels())
        for (const Model& model : models())
          for (const double distortion : model.distortions)
            for (std::size_t k = 0; k < 4; ++k)
              expectGradientIsTheDifference(kernels(level, model.model), parametersOf(model.model), data,
                                            withDistortion(data.normalized(data.poses[k]), distortion), {loss, 30, 2, 50},
                                            points);
}

TEST(Kernels, ANarrowedLossIsNarrowerWithTheSameCurvatureAtEveryLevel) {
  test::Random random(test::testSeed(), 17);
  const Data data(random, 61, 4);
  std::vector<double> values(61);
  for (double& value : values) value = random.uniform(1, 50);
  const correspondences::PaddedValues narrowing(values, 1);
  const QueryPose pose = data.normalized(data.poses[0]);
  for (const Loss loss : kLosses)
    for (const SimdLevel level : levels()) {
      const KindLoss spec{loss, 1000, 0.25, 1e9};  // wide: no error is infinite
      double cost = 0;
      for (std::size_t i = 0; i < data.scene.bearings.size(); ++i)
        cost += expectedCost(data.sampson(data.poses[0], i), spec, narrowing[i]);
      EXPECT_NEAR(sums(kernels(level), data, pose, spec, false, true, narrowing.pointer()).cost, cost, 1e-8 * cost);
      expectGradientIsTheDifference(kernels(level), correspondences::kFocalPoseParameters, data, pose, spec, false,
                                    narrowing.pointer());
    }
}

TEST(Kernels, LeveragesAreEqualAtAllLevels) {
  test::Random random(test::testSeed(), 18);
  const Data data(random, 61, 4);
  Eigen::Matrix<double, kMostParameters, kMostParameters> covariance;
  covariance.setIdentity();
  covariance(2, 5) = covariance(5, 2) = 0.5;
  covariance.row(7) *= kDistortionUnit;
  covariance.col(7) *= kDistortionUnit;
  for (const Model& model : models()) {
    const PlainPose pose = data.plain(withDistortion(data.poses[0], model.distortions[0]));
    for (const Loss loss : kLosses) {
      std::vector<double> expected(64), actual(64);
      const KindLoss spec{loss, 20, 0.5, 50};
      const auto leverages = [&](SimdLevel level, std::vector<double>& result) {
        kernels(level, model.model).rayLeverages(data.arrays.rayArrays(), pose, spec, covariance.data(), result.data());
      };
      leverages(SimdLevel::Baseline, expected);
      for (const SimdLevel level : levels()) {
        leverages(level, actual);
        for (std::size_t i = 0; i < 61; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-9 * (1 + expected[i]));
      }
    }
  }
}

// The rows of the rays or of the points, their columns one after the other, and the number of rows of each.
struct Rows {
  Rows(std::size_t size, std::size_t columns) : length(correspondences::padded(size)), values(columns * length) {}
  double operator()(std::size_t row, std::size_t column) const { return values[column * length + row]; }

  std::size_t length;
  std::vector<double> values;
};

// J^T W J of one row, with its derivatives in the columns from `first` on.
void addRow(const Rows& rows, std::size_t row, std::size_t first, int parameters, NormalEquations& sums) {
  for (int i = 0; i < parameters; ++i)
    for (int k = i; k < parameters; ++k)
      sums.hessian[i][k] +=
          rows(row, 0) * rows(row, first + static_cast<std::size_t>(i)) * rows(row, first + static_cast<std::size_t>(k));
}

void expectSameHessian(const NormalEquations& actual, const NormalEquations& expected, int parameters) {
  for (int i = 0; i < parameters; ++i)
    for (int k = i; k < parameters; ++k) {
      const double scale = std::sqrt(expected.hessian[i][i] * expected.hessian[k][k]);
      EXPECT_NEAR(actual.hessian[i][k], expected.hessian[i][k], 1e-9 * scale) << i << ", " << k;
    }
}

TEST(Kernels, RowsAddUpToTheNormalEquationsAtEveryLevel) {
  test::Random random(test::testSeed(), 24);
  const Data data(random, 61, 63);
  for (const Model& model : models())
    for (const double distortion : model.distortions)
      for (const Loss loss : kLosses)
        for (const SimdLevel level : levels()) {
          const Kernels& tested = kernels(level, model.model);
          const QueryPose pose = withDistortion(data.normalized(data.poses[0]), distortion);
          const KindLoss spec{loss, 20, 0.5, 50};
          Rows rays(61, kRayRow), points(63, kPointRow);
          tested.rayRows(data.arrays.rayArrays(), toPlain(pose), spec, rays.values.data());
          tested.pointRows(data.arrays.pointArrays(), toPlain(pose), spec, points.values.data());
          NormalEquations ofRays, ofPoints;
          ImageShiftSums shifts, expectedShifts;
          for (std::size_t i = 0; i < 61; ++i) {
            if (!(rays(i, 0) > 0)) continue;
            addRow(rays, i, 1, parametersOf(model.model), ofRays);
            for (std::size_t k = 0; k < kMostParameters; ++k) {
              shifts.alongU[k] += rays(i, 0) * rays(i, 1 + k) * rays(i, 9);
              shifts.alongV[k] += rays(i, 0) * rays(i, 1 + k) * rays(i, 10);
            }
          }
          for (std::size_t i = 0; i < 63; ++i) {
            if (!(points(i, 0) > 0)) continue;
            addRow(points, i, 1, parametersOf(model.model), ofPoints);
            addRow(points, i, 1 + kMostParameters, parametersOf(model.model), ofPoints);
          }
          expectSameHessian(ofRays, sums(tested, data, pose, spec, false, true), parametersOf(model.model));
          expectSameHessian(ofPoints, sums(tested, data, pose, spec, true, false), parametersOf(model.model));
          tested.addRayShifts(data.arrays.rayArrays(), toPlain(pose), spec, expectedShifts);
          for (int k = 0; k < parametersOf(model.model); ++k) {
            const double scale = 1e-9 * std::sqrt(61 * ofRays.hessian[k][k]);
            EXPECT_NEAR(shifts.alongU[k], expectedShifts.alongU[k], scale);
            EXPECT_NEAR(shifts.alongV[k], expectedShifts.alongV[k], scale);
          }
        }
}

// With one ray J^T J is the square of the error's derivative, which the Sampson denominator enters.
TEST(Kernels, OneRaysInformationIsTheSquareOfTheCentralDifferenceOfItsError) {
  test::Random random(test::testSeed(), 15);
  for (const Model& model : models())
    for (int repeat = 0; repeat < 50; ++repeat) {
      const Data data(random, 1, 4);
      const Kernels& tested = kernels(math::supportedSimdLevel(), model.model);
      const double distortion = model.distortions[static_cast<std::size_t>(repeat) % model.distortions.size()];
      const QueryPose pose =
          withDistortion(data.normalized(test::perturbed(random, data.scene.truth, 0.02, 0.2, 0.05)), distortion);
      const auto error = [&](const QueryPose& at) {
        double squared[correspondences::kPadding];
        tested.squaredRayErrors(data.arrays.rayArrays(), toPlain(at), squared);
        return std::sqrt(squared[0]);
      };
      if (!(error(pose) > 1 && error(pose) < 1e6)) continue;  // where the sign changes there is no derivative
      Eigen::VectorXd derivative(parametersOf(model.model));
      const double h = 1e-6;
      for (int i = 0; i < derivative.size(); ++i)
        derivative[i] = (error(moved(pose, i, h)) - error(moved(pose, i, -h))) / (2 * h);
      if (!derivative.allFinite()) continue;
      const NormalEquations at = sums(tested, data, pose, {}, false, true);
      const double tolerance = 1e-5 * derivative.squaredNorm();
      for (int row = 0; row < derivative.size(); ++row)
        for (int column = row; column < derivative.size(); ++column)
          EXPECT_NEAR(unitOf(row) * unitOf(column) * at.hessian[row][column], derivative[row] * derivative[column], tolerance);
    }
}

// The same for one point, which has two errors.
TEST(Kernels, APointsInformationIsTheSquareOfTheCentralDifferencesOfItsProjection) {
  test::Random random(test::testSeed(), 19);
  for (const Model& model : models())
    for (int repeat = 0; repeat < 50; ++repeat) {
      const Data data(random, 1, 1);
      const double distortion = model.distortions[static_cast<std::size_t>(repeat) % model.distortions.size()];
      const QueryPose pose =
          withDistortion(data.normalized(test::perturbed(random, data.scene.truth, 0.02, 0.2, 0.05)), distortion);
      const Eigen::Vector3d point = data.arrays.points()[0].point;
      const auto projection = [&](const QueryPose& at) {
        const Eigen::Vector3d y = at.rotation.transpose() * (point - at.position);
        return Eigen::Vector2d(distort(at.distortion, {at.focalLength * y[0], at.focalLength * y[1], y[2]})->head<2>());
      };
      Eigen::Matrix2Xd derivative(2, parametersOf(model.model));
      const double h = 1e-6;
      for (int i = 0; i < derivative.cols(); ++i)
        derivative.col(i) = (projection(moved(pose, i, h)) - projection(moved(pose, i, -h))) / (2 * h);
      const Eigen::MatrixXd expected = derivative.transpose() * derivative;
      for (const SimdLevel level : levels()) {
        const NormalEquations at = sums(kernels(level, model.model), data, pose, {}, true, false);
        for (int row = 0; row < derivative.cols(); ++row)
          for (int column = row; column < derivative.cols(); ++column)
            EXPECT_NEAR(unitOf(row) * unitOf(column) * at.hessian[row][column], expected(row, column),
                        1e-6 * std::sqrt(expected(row, row) * expected(column, column)) + 1e-3);
      }
    }
}

// The arrays of image points that are all moved.
struct MovedImage {
  MovedImage(const Data& data, double du, double dv) {
    const auto moved = [](const double* column, std::size_t size, double step) {
      std::vector<double> result(column, column + correspondences::padded(size));
      for (double& value : result) value += step;
      return result;
    };
    points = data.arrays.pointArrays();
    rays = data.arrays.rayArrays();
    columns = {moved(points.u, points.size, du), moved(points.v, points.size, dv), moved(rays.u, rays.size, du),
               moved(rays.v, rays.size, dv)};
    points.u = columns[0].data();
    points.v = columns[1].data();
    rays.u = columns[2].data();
    rays.v = columns[3].data();
  }
  PointArrays points;
  RayArrays rays;
  std::vector<std::vector<double>> columns;
};

// J^T d for one ray, J and d by central differences.
TEST(Kernels, OneRaysSumsForAMovedImageAreThoseOfTheCentralDifferencesAtEveryLevel) {
  test::Random random(test::testSeed(), 22);
  int compared = 0;
  for (const Model& model : models())
    for (int repeat = 0; repeat < 50; ++repeat) {
      const Data data(random, 1, 4);
      const double distortion = model.distortions[static_cast<std::size_t>(repeat) % model.distortions.size()];
      const QueryPose pose =
          withDistortion(data.normalized(test::perturbed(random, data.scene.truth, 0.02, 0.2, 0.05)), distortion);
      const auto error = [&](const QueryPose& at, double du, double dv) {
        double squared[correspondences::kPadding];
        kernels(model.model).squaredRayErrors(MovedImage(data, du, dv).rays, toPlain(at), squared);
        return std::sqrt(squared[0]);
      };
      if (!(error(pose, 0, 0) > 1 && error(pose, 0, 0) < 1e6)) continue;  // where the sign changes there is no derivative
      const double h = 1e-6, step = 1e-4;
      const double byU = (error(pose, step, 0) - error(pose, -step, 0)) / (2 * step);
      const double byV = (error(pose, 0, step) - error(pose, 0, -step)) / (2 * step);
      Eigen::VectorXd derivative(parametersOf(model.model));
      for (int i = 0; i < derivative.size(); ++i)
        derivative[i] = (error(moved(pose, i, h), 0, 0) - error(moved(pose, i, -h), 0, 0)) / (2 * h);
      if (!derivative.allFinite() || !std::isfinite(byU) || !std::isfinite(byV)) continue;
      ++compared;
      for (const SimdLevel level : levels()) {
        ImageShiftSums at;
        kernels(level, model.model).addRayShifts(data.arrays.rayArrays(), toPlain(pose), {}, at);
        const double tolerance = 1e-5 * derivative.norm();
        for (int row = 0; row < derivative.size(); ++row) {
          EXPECT_NEAR(unitOf(row) * at.alongU[row], derivative[row] * byU, tolerance);
          EXPECT_NEAR(unitOf(row) * at.alongV[row], derivative[row] * byV, tolerance);
        }
      }
    }
  EXPECT_GT(compared, 50);
}

// Points' errors are linear in their places in the image: the gradient changes by the sums times the shift, as long as the weights stay.
TEST(Kernels, PointsSumsForAMovedImageAreTheDifferencesOfTheGradientAtEveryLevel) {
  test::Random random(test::testSeed(), 23);
  const Data data(random, 4, 63);
  constexpr double kShift = 3;
  for (const Model& model : models())
    for (const double distortion : model.distortions)
      for (const SimdLevel level : levels()) {
        const Kernels& tested = kernels(level, model.model);
        const PlainPose pose = data.plain(withDistortion(data.poses[0], distortion));
        ImageShiftSums at;
        tested.addPointShifts(data.arrays.pointArrays(), pose, {}, at);
        NormalEquations still, alongU, alongV;
        tested.addPoints(data.arrays.pointArrays(), pose, {}, still);
        tested.addPoints(MovedImage(data, kShift, 0).points, pose, {}, alongU);
        tested.addPoints(MovedImage(data, 0, kShift).points, pose, {}, alongV);
        for (int row = 0; row < parametersOf(model.model); ++row) {
          const double tolerance = 1e-9 * (1 + std::abs(still.gradient[row]));
          EXPECT_NEAR(at.alongU[row] * kShift, alongU.gradient[row] - still.gradient[row], tolerance);
          EXPECT_NEAR(at.alongV[row] * kShift, alongV.gradient[row] - still.gradient[row], tolerance);
        }
      }
}

TEST(Kernels, SumsForAMovedImageHaveTheWeightsOfTheLossAtEveryLevel) {
  test::Random random(test::testSeed(), 24);
  const Data data(random, 61, 63);
  const PlainPose pose = data.plain(data.poses[0]);
  const KindLoss spec{Loss::Truncated, 3, 0.5, 1};
  std::vector<double> points(64), rays(64);
  kernels().squaredPointErrors(data.arrays.pointArrays(), pose, points.data());
  kernels().squaredRayErrors(data.arrays.rayArrays(), pose, rays.data());
  ImageShiftSums none;
  const KindLoss narrow{Loss::Truncated, 1e-9, 0.5, 1};
  kernels().addPointShifts(data.arrays.pointArrays(), pose, narrow, none);
  kernels().addRayShifts(data.arrays.rayArrays(), pose, narrow, none);
  for (int row = 0; row < kMostParameters; ++row) EXPECT_EQ(none.alongU[row], 0);
  ImageShiftSums expected;
  kernels(SimdLevel::Baseline).addPointShifts(data.arrays.pointArrays(), pose, spec, expected);
  kernels(SimdLevel::Baseline).addRayShifts(data.arrays.rayArrays(), pose, spec, expected);
  for (const SimdLevel level : levels()) {
    ImageShiftSums actual;
    kernels(level).addPointShifts(data.arrays.pointArrays(), pose, spec, actual);
    kernels(level).addRayShifts(data.arrays.rayArrays(), pose, spec, actual);
    for (int row = 0; row < correspondences::kFocalPoseParameters; ++row) {
      EXPECT_NEAR(actual.alongU[row], expected.alongU[row], 1e-9 * (1 + std::abs(expected.alongU[row])));
      EXPECT_NEAR(actual.alongV[row], expected.alongV[row], 1e-9 * (1 + std::abs(expected.alongV[row])));
    }
  }
}

TEST(Kernels, NormalEquationsAreEqualAtAllLevels) {
  test::Random random(test::testSeed(), 16);
  const Data data(random, 61, 63);
  for (const Model& model : models())
    for (const Loss loss : kLosses) {
      const QueryPose pose = withDistortion(data.normalized(data.poses[1]), model.distortions[0]);
      const KindLoss spec{loss, 20, 0.5, 50};
      const NormalEquations expected = sums(kernels(SimdLevel::Baseline, model.model), data, pose, spec, true, true);
      for (const SimdLevel level : levels()) {
        const NormalEquations actual = sums(kernels(level, model.model), data, pose, spec, true, true);
        if (std::isfinite(expected.cost)) {
          EXPECT_NEAR(actual.cost, expected.cost, 1e-9 * expected.cost);
        }
        for (int row = 0; row < parametersOf(model.model); ++row)
          for (int column = row; column < parametersOf(model.model); ++column)
            EXPECT_NEAR(unitOf(row) * unitOf(column) * actual.hessian[row][column],
                        unitOf(row) * unitOf(column) * expected.hessian[row][column], 1e-7 * expected.hessian[0][0]);
      }
    }
}

TEST(Kernels, WithoutDistortionARadialCameraIsAPinholeCamera) {
  test::Random random(test::testSeed(), 20);
  const Data data(random, 61, 63);
  const QueryPose pose = data.normalized(data.poses[0]);
  for (const SimdLevel level : levels()) {
    const NormalEquations pinhole = sums(kernels(level), data, pose, {}, true, true);
    const NormalEquations radial = sums(kernels(level, CameraModel::Radial), data, pose, {}, true, true);
    EXPECT_NEAR(radial.cost, pinhole.cost, 1e-9 * pinhole.cost);
    for (int row = 0; row < correspondences::kFocalPoseParameters; ++row)
      for (int column = row; column < correspondences::kFocalPoseParameters; ++column)
        EXPECT_NEAR(radial.hessian[row][column], pinhole.hessian[row][column], 1e-9 * pinhole.hessian[0][0]);
  }
  EXPECT_EQ(&kernelsFor(toPlain(pose)), &kernels());
  EXPECT_EQ(&kernelsFor(toPlain(withDistortion(pose, -1e-9))), &kernels(CameraModel::Radial));
}

// Points that strong pincushion distortion moves beyond every image point, and rays at image points that see nothing.
TEST(Kernels, WhatALensCannotSeeHasAnInfiniteErrorAndNoWeight) {
  test::Random random(test::testSeed(), 21);
  const Data data(random, 40, 40);
  for (const double distortion : {-1e-4, 1e-4})
    for (const SimdLevel level : levels()) {
      const Kernels& tested = kernels(level, CameraModel::Radial);
      const QueryPose pose = withDistortion(data.poses[0], distortion);
      std::vector<double> points(48), rays(48);
      tested.squaredPointErrors(data.arrays.pointArrays(), data.plain(pose), points.data());
      tested.squaredRayErrors(data.arrays.rayArrays(), data.plain(pose), rays.data());
      int infinite = 0;
      for (std::size_t i = 0; i < 40; ++i) {
        infinite += std::isinf(points[i]) + std::isinf(rays[i]);
        EXPECT_FALSE(std::isnan(points[i]) || std::isnan(rays[i]));
      }
      EXPECT_GT(infinite, 10);
      const NormalEquations at = sums(tested, data, data.normalized(pose), {Loss::Truncated, 30, 2, 50}, true, true);
      EXPECT_TRUE(std::isfinite(at.cost));
      for (int row = 0; row < kMostParameters; ++row) EXPECT_TRUE(std::isfinite(at.gradient[row]));
    }
}

}  // namespace
}  // namespace hybridgv
