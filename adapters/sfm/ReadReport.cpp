#include "hybridgv/adapters/sfm/ReadReport.hpp"

#include <algorithm>

namespace hybridgv {
namespace sfm {

const char* toString(Mend mend) {
  switch (mend) {
    case Mend::ByteOrderMark:
      return "text files start with a byte order mark: skipped, UTF-16 converted";
    case Mend::FractionForInteger:
      return "numbers are written with a fraction where an integer belongs: taken as integers";
    case Mend::ColourOutOfRange:
      return "colours are not in 0 .. 255: clamped";
    case Mend::CutLastLine:
      return "text files end in the middle of a line: its incomplete part left out";
    case Mend::NameWithSpaces:
      return "image names contain spaces that are not quoted: taken as they are";
    case Mend::UnusableName:
      return "images have no name, or one with a line break or a zero byte: called image_ID";
    case Mend::UnknownCameraModel:
      return "cameras have an unknown model: their images are not used";
    case Mend::UnusableCamera:
      return "cameras have parameters that make no sense: their images are not used";
    case Mend::ImageWithoutCamera:
      return "images name a camera that is not there: left out";
    case Mend::ImageWithoutUsablePose:
      return "images have a pose that makes no sense: not used";
    case Mend::PointNotFinite:
      return "points are not finite: left out";
    case Mend::PointErrorNotFinite:
      return "stored errors of points are not finite: taken as unknown";
    case Mend::ObservationNotFinite:
      return "observations are not finite: not used";
    case Mend::ObservationOfMissingPoint:
      return "observations name a point that is not there: taken as observations without a point";
    case Mend::TrackOfMissingImage:
      return "elements of tracks name an image that is not there: left out";
    case Mend::TrackOfUnregisteredImage:
      return "elements of tracks name an image without pose: left out";
    case Mend::TrackWithWrongNumber:
      return "elements of tracks name an observation that does not see the point: left out, what the images say is used";
    case Mend::TrackWithRepetition:
      return "elements of tracks name an observation again: left out";
    case Mend::ObservationNotInTrack:
      return "observations name a point whose track does not list them: listed";
    case Mend::ObservationWithoutId:
      return "observations are named by tracks only: given their points";
    case Mend::FrameOfMissingImage:
      return "elements of frames name an image that is not there: left out";
    case Mend::RigOrFrameInvalid:
      return "rigs or frames refer to things that are not there: left out";
    case Mend::FrameContradictsImage:
      return "frames have a pose that differs from their image's: the image's is used";
    case Mend::OriginOfImagePositions:
      return "cameras have image positions that count from another origin: the principal point was moved there";
  }
  return "unknown mend";
}

bool ReadReport::isEmpty() const {
  return notes.empty() && std::all_of(counts.begin(), counts.end(), [](std::size_t count) { return count == 0; });
}

std::vector<std::string> ReadReport::sentences() const {
  std::vector<std::string> result = notes;
  for (std::size_t i = 0; i < kMendCount; ++i)
    if (counts[i] > 0)
      result.push_back(std::to_string(counts[i]) + " " + toString(static_cast<Mend>(i)) + " (first: " + firstPlaces[i] + ")");
  return result;
}

}  // namespace sfm
}  // namespace hybridgv
