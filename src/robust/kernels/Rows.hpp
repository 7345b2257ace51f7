// The equations of every correspondence by itself, for any camera model: that of a radial one, without distortion, is a pinhole camera.
#pragma once

#include "robust/kernels/PointEquations.hpp"
#include "robust/kernels/Radial.hpp"
#include "robust/kernels/RayEquations.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// Stores one lane after the other to columns of equal length.
class ColumnWriter {
 public:
  ColumnWriter(double* first, std::size_t length) : next_(first), length_(length) {}
  void write(Doubles value) {
    store(next_, value);
    next_ += length_;
  }

 private:
  double* next_;
  std::size_t length_;
};

static inline std::size_t columnLength(std::size_t size) {
  return (size + correspondences::kPadding - 1) / correspondences::kPadding * correspondences::kPadding;
}

// The derivatives by the position, from the query's frame to the rig's.
HYBRIDGV_INLINE void turnPosition(const Pose& pose, Doubles* row) {
  const Vec3<Doubles> byPosition = pose.toRig({row[3], row[4], row[5]});
  row[3] = byPosition.x;
  row[4] = byPosition.y;
  row[5] = byPosition.z;
}

static void rayRows(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, double* columns) {
  const RadialPose pose(plainPose);
  CostSum cost(loss);
  const std::size_t length = columnLength(rays.size);
  for (std::size_t i = 0; i < length; ++i) columns[i] = 0;
  forWeightedRays<Radial>(
      rays, plainPose, pose, loss, cost,
      [&](std::size_t i, const RadialEpipolar& ray, Doubles variance, const Row<kMostParameters>& derivatives, Doubles weight) {
        const Doubles scale = 1 / squareRoot(variance);
        const ImageDerivatives byImage = differentiateByImage(ray, variance, pose);
        ColumnWriter writer(columns + i, length);
        writer.write(weight * variance);
        for (const Doubles& derivative : derivatives) writer.write(scale * derivative);
        writer.write(scale * byImage.byU);
        writer.write(scale * byImage.byV);
        writer.write(scale * ray.constraint);
      });
}

static void pointRows(const PointArrays& points, const PlainPose& plainPose, const KindLoss& loss, double* columns) {
  const RadialPose pose(plainPose);
  const Doubles inverseFocal = broadcast<Doubles>(1 / plainPose.focalLength);
  CostSum cost(loss);
  const std::size_t length = columnLength(points.size);
  for (std::size_t i = 0; i < length; ++i) columns[i] = 0;
  forWeightedPoints<Radial>(points, pose, cost, [&](std::size_t i, const RadialReprojection& point, Doubles weight) {
    Row<kMostParameters> byU, byV;
    differentiate(point, inverseFocal, pose, byU, byV);
    turnPosition(pose, byU);
    turnPosition(pose, byV);
    ColumnWriter writer(columns + i, length);
    writer.write(weight);
    for (const Doubles& derivative : byU) writer.write(derivative);
    for (const Doubles& derivative : byV) writer.write(derivative);
    writer.write(point.errorU);
    writer.write(point.errorV);
  });
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
