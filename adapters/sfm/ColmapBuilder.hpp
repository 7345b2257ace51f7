// What COLMAP's text and binary files have in common: parts of a model by their ids, and what is mended in them. Scanner is the
// scanner of the file that the part stands in.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <string>

#include "CameraModels.hpp"
#include "Mending.hpp"
#include "ModelLinks.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

class ColmapBuilder {
 public:
  // COLMAP's binary id of no point.
  static constexpr std::uint64_t kNoPointId = ~std::uint64_t{0};

  explicit ColmapBuilder(Mending& mending) : mending_(mending) {}

  // `modelName` is for the message about an unknown model.
  template <class Scanner>
  void addCamera(const Scanner& in, Camera camera, const std::string& modelName) {
    check(in, cameraIndex_.add(camera.id, model_.cameras.size()));
    const std::string fault = findCameraFault(camera);
    if (camera.model == CameraModel::Unknown) {
      mending_.note(Mend::UnknownCameraModel, [&] {
        return in.error("the camera model " + modelName + " of camera " + std::to_string(camera.id) + " is not known");
      });
    } else if (!fault.empty()) {
      mending_.note(Mend::UnusableCamera, [&] { return in.error("camera " + std::to_string(camera.id) + ": " + fault); });
    }
    isUsable_.push_back(fault.empty());
    model_.cameras.push_back(std::move(camera));
  }

  // How many points there will be.
  void reservePoints(std::size_t count) {
    model_.points.reserve(count);
    pointIndex_.reserve(count);
  }
  // Starts a point. False if it is left out.
  template <class Scanner>
  bool beginPoint(const Scanner& in, const Point& point) {
    const bool isFinite = point.position.allFinite();
    check(in, pointIndex_.add(point.id, isFinite ? model_.points.size() : IdIndex::kLeftOut));
    if (!isFinite) {
      mending_.note(Mend::PointNotFinite,
                    [&] { return in.error("the position of point " + std::to_string(point.id) + " is not finite"); });
      return false;
    }
    model_.points.push_back(point);
    double& error = model_.points.back().error;
    if (std::isfinite(error)) return true;
    mending_.note(Mend::PointErrorNotFinite,
                  [&] { return in.error("the error of point " + std::to_string(point.id) + " is not finite"); });
    error = -1;
    return true;
  }
  void addTrackEntry(const TrackEntry& entry) { tracks_.entries.push_back(entry); }
  void endPoint(std::size_t place) {
    tracks_.places.push_back(place);
    tracks_.begins.push_back(tracks_.entries.size());
  }

  template <class Scanner>
  Observation observation(const Scanner& in, double x, double y) {
    if (std::isfinite(x) && std::isfinite(y)) return {x, y, Observation::kNoPoint};
    mending_.note(Mend::ObservationNotFinite, [&] { return in.error("an observation is not finite"); });
    return {0, 0, kNowhere};
  }
  // Sets the observation's point.
  template <class Scanner>
  void setPoint(const Scanner& in, std::uint64_t id, Observation& observation) {
    if (observation.point == kNowhere) {
      observation.point = Observation::kNoPoint;
      return;
    }
    if (id == kNoPointId) return;
    const std::size_t point = pointIndex_.find(id);
    if (point == IdIndex::kNone)
      mending_.note(Mend::ObservationOfMissingPoint, [&] { return in.error(pointIndex_.unknown(id)); });
    else if (point != IdIndex::kLeftOut)
      observation.point = point;
  }

  // Starts an image, x_camera = R(q) X + t. False if it is left out; image() is to be given its observations in either case.
  template <class Scanner>
  bool beginImage(const Scanner& in, std::uint32_t id, const double q[4], const Eigen::Vector3d& t, std::uint32_t cameraId) {
    image_ = Image();
    image_.id = id;
    const std::size_t camera = cameraIndex_.find(cameraId);
    isImageKept_ = camera != IdIndex::kNone;
    check(in, imageIndex_.add(id, isImageKept_ ? model_.images.size() : IdIndex::kLeftOut));
    if (!isImageKept_) {
      mending_.note(Mend::ImageWithoutCamera,
                    [&] { return in.error("image " + std::to_string(id) + ": " + cameraIndex_.unknown(cameraId)); });
      return false;
    }
    image_.camera = camera;
    image_.registered = isUsable_[camera];
    const std::string fault = setPoseFromQuaternion(q, t, image_);
    if (fault.empty()) {
      image_.storedPose = {q[0], q[1], q[2], q[3], t[0], t[1], t[2]};
      image_.carried = !image_.registered;
      return true;
    }
    mending_.note(Mend::ImageWithoutUsablePose, [&] { return in.error("image " + std::to_string(id) + ": " + fault); });
    image_.registered = false;
    image_.rotation.setIdentity();
    image_.position.setZero();
    return true;
  }
  Image& image() { return image_; }
  void endImage() {
    if (!isImageKept_) return;
    if (!image_.registered && !image_.carried) image_.observations.clear();
    model_.images.push_back(std::move(image_));
  }

  const IdIndex& imageIndex() const { return imageIndex_; }
  Tracks& tracks() { return tracks_; }
  SparseModel& model() { return model_; }
  Mending& mending() { return mending_; }

 private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-3);

  template <class Scanner>
  static void check(const Scanner& in, const std::string& fault) {
    if (!fault.empty()) in.fail(fault);
  }

  Mending& mending_;
  SparseModel model_;
  IdIndex cameraIndex_{"camera"}, imageIndex_{"image"}, pointIndex_{"point"};
  std::vector<bool> isUsable_;  // the cameras
  Tracks tracks_;
  Image image_;
  bool isImageKept_ = false;
};

}  // namespace sfm
}  // namespace hybridgv
