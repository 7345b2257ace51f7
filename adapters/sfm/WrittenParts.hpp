// What of a model COLMAP's files can hold.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// The images that are registered or carried along, and the cameras that make sense or that those images have. A camera of unknown
// model has a name in text files and a number in binary ones; where it lacks the one that is needed, its images are left out.
class WrittenParts {
 public:
  enum class Format { Text, Binary };
  // std::invalid_argument for a registered image whose camera COLMAP cannot describe.
  WrittenParts(const SparseModel& model, Format format);

  const SparseModel& model() const { return model_; }
  const std::vector<Camera>& cameras() const { return cameras_; }  // in COLMAP's terms
  const std::vector<const Image*>& images() const { return images_; }
  bool hasImage(std::size_t index) const { return isImageWritten_[index] != 0; }
  // The elements of a point's track that name images which are written.
  std::vector<TrackElement> track(const Point& point) const;

  // COLMAP's number of a camera's model, as it stands in binary files.
  static std::int32_t modelNumber(const Camera& camera);
  // And its name in text files.
  static std::string modelName(const Camera& camera);

 private:
  const SparseModel& model_;
  std::vector<Camera> cameras_;
  std::vector<const Image*> images_;
  std::vector<char> isImageWritten_;
};

}  // namespace sfm
}  // namespace hybridgv
