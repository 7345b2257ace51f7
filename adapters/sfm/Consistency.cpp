#include "Consistency.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "CameraModels.hpp"
#include "lens/Lens.hpp"

namespace hybridgv {
namespace sfm {
namespace {

constexpr std::size_t kFewest = 20;     // observations, below which nothing is concluded
constexpr std::size_t kMost = 50000;    // observations that are looked at
constexpr double kLargestPx = 10;       // median error of a map that is accepted
constexpr double kLargestAngle = 0.01;  // [rad] likewise, for cameras with a long focal length: the larger one counts
// A correction must leave less than this share of the error.
constexpr double kSmallestGain = 0.1;

// An observation beside the projection of its point.
struct Sample {
  std::size_t camera;
  Eigen::Vector2d seen, projected;  // infinite if the camera cannot see the point
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::size_t countTrackElements(const SparseModel& model) {
  std::size_t count = 0;
  for (const Point& point : model.points) count += point.track.size();
  return count;
}

std::vector<Lens> lensesOf(const SparseModel& model) {
  static const Camera kPlaceholder{0, CameraModel::SimplePinhole, 0, 0, {1, 0, 0}};  // no registered image has it
  std::vector<Lens> lenses;
  for (const Camera& camera : model.cameras) lenses.emplace_back(findCameraFault(camera).empty() ? camera : kPlaceholder);
  return lenses;
}

// Every n-th track element, so that there are at most kMost.
std::vector<Sample> takeSamples(const SparseModel& model, const std::vector<Lens>& lenses) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t step = countTrackElements(model) / kMost + 1;
  std::vector<Sample> samples;
  std::size_t index = 0;
  for (const Point& point : model.points)
    for (const TrackElement& e : point.track) {
      if (index++ % step != 0) continue;
      const Image& image = model.images[e.image];
      if (!image.registered) continue;
      const Observation& o = image.observations[e.observation];
      const auto projected = lenses[image.camera].project(image.rotation.transpose() * (point.position - image.position));
      samples.push_back(
          {image.camera, {o.x, o.y}, projected ? *projected : Eigen::Vector2d(Eigen::Vector2d::Constant(kInfinity))});
    }
  return samples;
}

double medianError(const std::vector<Sample>& samples) {
  std::vector<double> errors;
  for (const Sample& s : samples) errors.push_back(std::hypot(s.seen[0] - s.projected[0], s.seen[1] - s.projected[1]));
  return median(errors);
}

double medianFocalLength(const std::vector<Sample>& samples, const std::vector<Lens>& lenses) {
  std::vector<double> values;
  for (const Sample& s : samples) values.push_back(lenses[s.camera].focalLength());
  return median(values);
}

// By how much the observations of each camera lie beside the projections, in the median of each coordinate; zero where nothing
// is known.
std::vector<Eigen::Vector2d> offsetsOf(const std::vector<Sample>& samples, std::size_t cameras) {
  std::vector<std::vector<double>> dx(cameras), dy(cameras);
  for (const Sample& s : samples) {
    if (!s.projected.allFinite()) continue;
    dx[s.camera].push_back(s.seen[0] - s.projected[0]);
    dy[s.camera].push_back(s.seen[1] - s.projected[1]);
  }
  std::vector<Eigen::Vector2d> offsets(cameras, Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < cameras; ++i)
    if (!dx[i].empty()) offsets[i] = {median(dx[i]), median(dy[i])};
  return offsets;
}

std::vector<Sample> shifted(std::vector<Sample> samples, const std::vector<Eigen::Vector2d>& offsets) {
  for (Sample& s : samples) s.projected += offsets[s.camera];
  return samples;
}

// The factor between the distances of observations and of projections from the principal points.
double scaleBetween(const std::vector<Sample>& samples, const std::vector<Lens>& lenses) {
  std::vector<double> ratios;
  for (const Sample& s : samples) {
    const auto centre = lenses[s.camera].project({0, 0, 1});
    if (!centre || !s.projected.allFinite()) continue;
    const double distance = (s.projected - *centre).norm();
    if (distance > 0) ratios.push_back((s.seen - *centre).norm() / distance);
  }
  return ratios.empty() ? 1 : median(ratios);
}

double medianErrorScaled(std::vector<Sample> samples, const std::vector<Lens>& lenses, double scale) {
  for (Sample& s : samples)
    if (const auto centre = lenses[s.camera].project({0, 0, 1})) s.projected = *centre + scale * (s.projected - *centre);
  return medianError(samples);
}

std::string inWords(double number) {
  constexpr int kDigits = 3;
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, number, std::chars_format::general, kDigits);
  return std::string(text, result.ptr);
}

std::string contradiction(const std::vector<Sample>& samples, const std::vector<Lens>& lenses, double error, double afterOffset) {
  std::string text = "the map contradicts itself: ";
  if (!std::isfinite(error)) return text + "more than half of its points lie where the images that see them cannot look";
  text += "its points miss their observations by " + inWords(error) + " px in the median";
  if (std::isfinite(afterOffset)) text += " (" + inWords(afterOffset) + " px after the best common offset)";
  const double scale = scaleBetween(samples, lenses), afterScale = medianErrorScaled(samples, lenses, scale);
  if (afterScale < kSmallestGain * error)
    return text + "; with all observations " + inWords(scale) + " times as far from the principal point it would be " +
           inWords(afterScale) + " px: the images' size or the focal length is not that of the observations";
  return text +
         "; image size, principal point or focal length are not those of the observations, or points and poses belong to "
         "different maps";
}

// Moves the principal points. Panoramas have none.
bool canMove(const Camera& camera, const Eigen::Vector2d& offset) {
  return offset.isZero(0) || camera.model != CameraModel::Equirectangular;
}

void movePrincipalPoint(Camera& camera, const Eigen::Vector2d& offset) {
  const std::size_t first = focalLengthCount(camera.model);
  camera.parameters[first] += offset[0];
  camera.parameters[first + 1] += offset[1];
}

}  // namespace

void checkConsistency(const std::string& path, Mending& mending, SparseModel& model) {
  if (!mending.options().checkConsistency) return;
  const std::vector<Lens> lenses = lensesOf(model);
  const std::vector<Sample> samples = takeSamples(model, lenses);
  if (samples.size() < kFewest) return;
  const double error = mending.report().medianErrorPx = medianError(samples);
  const double largest = std::max(kLargestPx, kLargestAngle * medianFocalLength(samples, lenses));
  if (error <= largest) return;

  const std::vector<Eigen::Vector2d> offsets = offsetsOf(samples, model.cameras.size());
  const double afterOffset = medianError(shifted(samples, offsets));
  bool isMended = afterOffset <= largest && afterOffset < kSmallestGain * error;
  for (std::size_t i = 0; i < offsets.size(); ++i) isMended = isMended && canMove(model.cameras[i], offsets[i]);
  if (!isMended) throw FileError::inFile(path, contradiction(samples, lenses, error, afterOffset));
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (offsets[i].isZero(0)) continue;
    mending.note(Mend::OriginOfImagePositions, [&] {
      return FileError::inFile(path, "the points miss their observations by " + inWords(error) + " px, by a common offset of (" +
                                         inWords(offsets[i][0]) + ", " + inWords(offsets[i][1]) + ") px in camera " +
                                         std::to_string(model.cameras[i].id) + "; without it by " + inWords(afterOffset) + " px");
    });
    movePrincipalPoint(model.cameras[i], offsets[i]);
  }
  mending.report().medianErrorPx = afterOffset;
}

}  // namespace sfm
}  // namespace hybridgv
