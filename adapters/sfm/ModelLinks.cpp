#include "ModelLinks.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace hybridgv {
namespace sfm {

std::string IdIndex::add(std::uint64_t id) {
  if (indices_.emplace(id, indices_.size()).second) return {};
  return std::string(kind_) + " " + std::to_string(id) + " occurs twice";
}

bool IdIndex::find(std::uint64_t id, std::size_t& index) const {
  const auto entry = indices_.find(id);
  if (entry == indices_.end()) return false;
  index = entry->second;
  return true;
}

std::string IdIndex::unknown(std::uint64_t id) const { return std::string("there is no ") + kind_ + " " + std::to_string(id); }

static std::string findUnlistedObservation(const SparseModel& model, const std::vector<std::vector<bool>>& listed) {
  for (std::size_t i = 0; i < model.images.size(); ++i)
    for (std::size_t j = 0; j < listed[i].size(); ++j) {
      const std::size_t point = model.images[i].observations[j].point;
      if (point != Observation::kNoPoint && !listed[i][j])
        return "observation " + std::to_string(j) + " of image " + std::to_string(model.images[i].id) + " names point " +
               std::to_string(model.points[point].id) + ", whose track does not list it";
    }
  return {};
}

std::string linkTracks(const std::vector<std::vector<TrackEntry>>& tracks, const IdIndex& imageIndex,
                       const std::function<void(std::size_t, const std::string&)>& fail, SparseModel& model) {
  std::vector<std::vector<bool>> listed;
  for (const Image& image : model.images) listed.emplace_back(image.observations.size(), false);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Point& point = model.points[i];
    const auto failElement = [&](const TrackEntry& e, const std::string& reason) {
      fail(i, "point " + std::to_string(point.id) + ", observation " + std::to_string(e.observation) + " of image " +
                  std::to_string(e.imageId) + ": " + reason);
    };
    point.track.reserve(tracks[i].size());
    for (const TrackEntry& entry : tracks[i]) {
      std::size_t image = 0;
      if (!imageIndex.find(entry.imageId, image)) failElement(entry, imageIndex.unknown(entry.imageId));
      const std::vector<Observation>& observations = model.images[image].observations;
      if (entry.observation >= observations.size())
        failElement(entry, "the image has " + std::to_string(observations.size()) + " observations");
      const auto observation = static_cast<std::size_t>(entry.observation);
      if (observations[observation].point != i) failElement(entry, "the image does not say that it sees this point");
      if (listed[image][observation]) failElement(entry, "is listed twice");
      listed[image][observation] = true;
      point.track.push_back({image, observation});
    }
  }
  return findUnlistedObservation(model, listed);
}

std::string setPoseFromQuaternion(const double q[4], const Eigen::Vector3d& translation, Image& image) {
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(norm > 0) || !std::isfinite(norm)) return "the rotation's quaternion has no direction";
  image.rotation =
      Eigen::Quaterniond(q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm).normalized().toRotationMatrix().transpose();
  image.position = -(image.rotation * translation);
  if (!image.position.allFinite()) return "the position is not finite";
  return {};
}

}  // namespace sfm
}  // namespace hybridgv
