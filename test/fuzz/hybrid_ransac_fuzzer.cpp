// The hybrid RANSAC on a few arbitrary correspondences: a result that can be relied on, a reason why there is none, or
// std::invalid_argument for data that are not finite.
#include <limits>

#include "RawAdapter.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace {

using namespace hybridgv;

constexpr std::size_t kRays = 6, kPoints = 8;

bool isFinitePose(const FocalPose& pose) {
  return pose.rotation.allFinite() && pose.position.allFinite() && std::isfinite(pose.focalLength) && pose.focalLength > 0;
}

void check(const sac::HybridRansacResult& result) {
  if (result.success != (result.failureReason == sac::FailureReason::None)) fuzz::reportFault("a failure has a reason");
  if (result.inliers2d2d.size() != kRays || result.inliers2d3d.size() != kPoints) fuzz::reportFault("masks are complete");
  if (result.score > 0 && !isFinitePose(result.pose)) fuzz::reportFault("poses are finite");
  for (const double entry : result.covariance)
    if (std::isnan(entry)) fuzz::reportFault("covariances are numbers");
  if (std::isnan(result.score) || std::isnan(result.focalLengthStandardDeviation) || std::isnan(result.noise2d2d) ||
      std::isnan(result.noise2d3d))
    fuzz::reportFault("results are numbers");
  if (!std::isfinite(result.distortion) || std::isnan(result.distortionStandardDeviation) ||
      !std::isfinite(result.simpleRadialFocalLength) || !std::isfinite(result.simpleRadialK1) ||
      std::isnan(result.simpleRadialK1StandardDeviation))
    fuzz::reportFault("lenses are numbers");
  if (result.success && !std::isfinite(result.focalLengthStandardDeviation))
    fuzz::reportFault("a successful result is determined");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Sample sample = fuzz::decodeSample(data, size, kRays, kPoints);
  sac::HybridRansacOptions options;
  options.maxIterations = 30;
  try {
    check(sac::hybridRansac(fuzz::RawAdapter(sample), options));
    options.queryCamera = sac::QueryCamera::Radial;
    // By turns kept always, and if the data speak for it.
    if (size % 2 == 1) options.distortionEvidence = -std::numeric_limits<double>::infinity();
    check(sac::hybridRansac(fuzz::RawAdapter(sample), options));
  } catch (const std::invalid_argument&) {
    return 0;
  }
  if (!fuzz::isFinite(sample)) fuzz::reportFault("data that are not finite are refused");
  return 0;
}
