#include "ModelLinks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace sfm {

void IdIndex::grow() {
  const std::size_t size = slots_.empty() ? 16 : 2 * slots_.size();
  const std::vector<Slot> old = std::move(slots_);
  slots_.assign(size, {0, kNone});
  shift_ = 64;
  for (std::size_t n = size; n > 1; n /= 2) --shift_;
  for (const Slot& slot : old) {
    if (slot.index == kNone) continue;
    std::size_t i = firstSlot(slot.id);
    while (slots_[i].index != kNone) i = (i + 1) & (size - 1);
    slots_[i] = slot;
  }
}

// At most four times as large as their number, so that the table is not large either.
bool IdIndex::isSmall(std::uint64_t id, std::size_t index) const {
  constexpr std::size_t kStart = 64;
  return id / 4 < std::max(reserved_, count_) + kStart && (index < kSmallLeftOut || index == kLeftOut);
}

void IdIndex::addSmall(std::size_t id, std::size_t index) {
  if (id >= small_.size()) small_.resize(std::max(id + 1, 2 * small_.size()), kFree);
  small_[id] = index == kLeftOut ? kSmallLeftOut : static_cast<std::uint32_t>(index);
}

void IdIndex::addSlot(std::uint64_t id, std::size_t index) {
  if (2 * (taken_ + 1) > slots_.size()) grow();
  std::size_t i = firstSlot(id);
  while (slots_[i].index != kNone) i = (i + 1) & (slots_.size() - 1);
  slots_[i] = {id, index};
  ++taken_;
}

std::string IdIndex::add(std::uint64_t id, std::size_t index) {
  if (find(id) != kNone) return std::string(kind_) + " " + std::to_string(id) + " occurs twice";
  if (isSmall(id, index))
    addSmall(static_cast<std::size_t>(id), index);
  else
    addSlot(id, index);
  ++count_;
  return {};
}

std::size_t IdIndex::findInSlots(std::uint64_t id) const {
  std::size_t i = firstSlot(id);
  while (slots_[i].index != kNone && slots_[i].id != id) i = (i + 1) & (slots_.size() - 1);
  return slots_[i].index;
}

std::string IdIndex::unknown(std::uint64_t id) const { return std::string("there is no ") + kind_ + " " + std::to_string(id); }

namespace {

// Which observations a track has listed, and which images name no points at all.
struct Listing {
  explicit Listing(const SparseModel& model) {
    std::size_t count = 0;
    for (const Image& image : model.images) {
      firsts.push_back(count);
      count += image.observations.size();
      bool names = false;
      for (const Observation& o : image.observations) names = names || o.point != Observation::kNoPoint;
      namesPoints.push_back(names);
    }
    isListed.assign(count, 0);
  }
  std::vector<std::size_t> firsts;
  std::vector<char> isListed, namesPoints;
};

class Linker {
 public:
  Linker(const Tracks& tracks, const IdIndex& imageIndex,
         const std::function<FileError(std::size_t, const std::string&)>& errorAt, Mending& mending, SparseModel& model)
      : tracks_(tracks), imageIndex_(imageIndex), errorAt_(errorAt), mending_(mending), model_(model), listing_(model) {}

  void link(std::size_t point) {
    std::vector<TrackElement>& track = model_.points[point].track;
    track.reserve(tracks_.begins[point + 1] - tracks_.begins[point]);
    for (std::size_t i = tracks_.begins[point]; i < tracks_.begins[point + 1]; ++i) {
      const TrackEntry& entry = tracks_.entries[i];
      const std::size_t image = imageIndex_.find(entry.imageId);
      if (accept(point, entry, image)) track.push_back({image, entry.observation});
    }
  }

  // Observations whose point does not list them are added to its track.
  void addUnlisted(const std::function<FileError(const std::string&)>& imagesError) {
    for (std::size_t i = 0; i < model_.images.size(); ++i)
      for (std::size_t j = 0; j < model_.images[i].observations.size(); ++j) {
        const std::size_t point = model_.images[i].observations[j].point;
        if (point == Observation::kNoPoint || listing_.isListed[listing_.firsts[i] + j] != 0) continue;
        mending_.note(Mend::ObservationNotInTrack, [&] {
          return imagesError("observation " + std::to_string(j) + " of image " + std::to_string(model_.images[i].id) +
                             " names point " + std::to_string(model_.points[point].id) + ", whose track does not list it");
        });
        model_.points[point].track.push_back({i, j});
      }
  }

 private:
  // Is the entry an element of the point's track? If it is not, that is noted.
  bool accept(std::size_t point, const TrackEntry& entry, std::size_t image) {
    const auto refuse = [&](Mend mend, const auto& reason) {
      mending_.note(mend, [&] { return error(point, entry, reason()); });
      return false;
    };
    if (image >= model_.images.size())
      return refuse(Mend::TrackOfMissingImage, [&] { return imageIndex_.unknown(entry.imageId); });
    if (!model_.images[image].registered && !model_.images[image].carried)
      return refuse(Mend::TrackOfUnregisteredImage, [] { return std::string("the image is not registered"); });
    std::vector<Observation>& observations = model_.images[image].observations;
    if (entry.observation >= observations.size())
      return refuse(Mend::TrackWithWrongNumber,
                    [&] { return "the image has " + std::to_string(observations.size()) + " observations"; });
    Observation& observation = observations[entry.observation];
    if (observation.point == Observation::kNoPoint && listing_.namesPoints[image] == 0) {
      refuse(Mend::ObservationWithoutId, [] { return std::string("the image names no points"); });
      observation.point = point;
    }
    if (observation.point != point)
      return refuse(Mend::TrackWithWrongNumber, [] { return std::string("the image does not say that it sees this point"); });
    char& isListed = listing_.isListed[listing_.firsts[image] + entry.observation];
    if (isListed != 0) return refuse(Mend::TrackWithRepetition, [] { return std::string("is listed twice"); });
    isListed = 1;
    return true;
  }

  FileError error(std::size_t point, const TrackEntry& entry, const std::string& reason) const {
    return errorAt_(point, "point " + std::to_string(model_.points[point].id) + ", observation " +
                               std::to_string(entry.observation) + " of image " + std::to_string(entry.imageId) + ": " + reason);
  }

  const Tracks& tracks_;
  const IdIndex& imageIndex_;
  const std::function<FileError(std::size_t, const std::string&)>& errorAt_;
  Mending& mending_;
  SparseModel& model_;
  Listing listing_;
};

}  // namespace

void linkTracks(const Tracks& tracks, const IdIndex& imageIndex,
                const std::function<FileError(std::size_t, const std::string&)>& errorAt,
                const std::function<FileError(const std::string&)>& imagesError, Mending& mending, SparseModel& model) {
  Linker linker(tracks, imageIndex, errorAt, mending, model);
  for (std::size_t i = 0; i < model.points.size(); ++i) linker.link(i);
  linker.addUnlisted(imagesError);
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

std::string setPoseFromMatrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation, Image& image) {
  constexpr double kTolerance = 1e-3;  // of R^T R = I
  const Eigen::Matrix3d error = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
  if (!(error.cwiseAbs().maxCoeff() < kTolerance) || rotation.determinant() < 0) return "the matrix is not a rotation";
  image.rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix().transpose();
  image.position = -(image.rotation * translation);
  if (!image.position.allFinite()) return "the position is not finite";
  return {};
}

}  // namespace sfm
}  // namespace hybridgv
