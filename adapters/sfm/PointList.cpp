#include "PointList.hpp"

#include <cmath>

namespace hybridgv {
namespace sfm {
namespace {

constexpr std::size_t kViewBytes = std::size_t{4} * 2;

class PointListReader {
 public:
  PointListReader(TextScanner& in, std::string imageWord, double signOfY, SparseModel& model)
      : in_(in), imageWord_(std::move(imageWord)), signOfY_(signOfY), model_(model) {}

  void readPoint(std::size_t number) {
    Point point;
    point.id = number;
    for (double& coordinate : point.position) coordinate = in_.anyNumber("the position of a point");
    for (std::uint8_t& channel : point.colour) channel = in_.colour("the colour of a point");
    const bool isKept = point.position.allFinite();
    if (!isKept) note(Mend::PointNotFinite, "the position of point " + std::to_string(number) + " is not finite");
    const std::size_t views = in_.count("the number of views of a point", kViewBytes);
    const std::size_t index = isKept ? model_.points.size() : Observation::kNoPoint;
    if (isKept) {
      point.track.reserve(views);
      model_.points.push_back(std::move(point));
    }
    for (std::size_t i = 0; i < views; ++i) readView(index);
  }

 private:
  void note(Mend mend, const std::string& reason) {
    in_.mending().note(mend, [&] { return in_.error(reason); });
  }

  // `point` is Observation::kNoPoint if the point is left out.
  void readView(std::size_t point) {
    const auto index = in_.integer<std::size_t>("the image of a view");
    if (index >= model_.images.size()) in_.fail("there is no " + imageWord_ + " " + std::to_string(index));
    in_.integer<std::int64_t>("the key of a view");
    const double x = in_.anyNumber("the position of a view"), y = in_.anyNumber("the position of a view");
    Image& image = model_.images[index];
    if (!image.registered) {
      note(Mend::TrackOfUnregisteredImage, imageWord_ + " " + std::to_string(index) + " has no pose and sees a point");
      return;
    }
    if (!std::isfinite(x) || !std::isfinite(y)) {
      note(Mend::ObservationNotFinite, "the position of a view is not finite");
      return;
    }
    if (point != Observation::kNoPoint) model_.points[point].track.push_back({index, image.observations.size()});
    image.observations.push_back({x, signOfY_ * y, point});
  }

  TextScanner& in_;
  const std::string imageWord_;
  const double signOfY_;
  SparseModel& model_;
};

}  // namespace

void readPointList(TextScanner& in, std::size_t count, const char* image, double signOfY, SparseModel& model) {
  model.points.reserve(count);
  PointListReader reader(in, image, signOfY, model);
  for (std::size_t i = 0; i < count; ++i) reader.readPoint(i);
}

}  // namespace sfm
}  // namespace hybridgv
