/// \file
/// \brief What a reader has mended in a map, and how strict it is.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// What maps written by other programs and scripts have wrong without being useless.
enum class Mend {
  ByteOrderMark,           ///< a byte order mark at the start of a text file, or UTF-16 instead of UTF-8: converted
  FractionForInteger,      ///< 128.0 where an integer belongs: taken as 128
  ColourOutOfRange,        ///< a colour that is not in 0 .. 255: clamped, 0 if it is not a number
  CutLastLine,             ///< the last line of a text file is not complete: its incomplete part left out
  NameWithSpaces,          ///< an NVM image name with spaces that are not quoted: taken as it is
  UnusableName,            ///< an image whose name is empty, or has a line break or a zero byte: called image_ID, ID its number
  UnknownCameraModel,      ///< a camera of an unknown model: its images are not used, only carried along
  UnusableCamera,          ///< a camera whose focal length or parameters make no sense: its images are not registered
  ImageWithoutCamera,      ///< an image whose camera is missing: left out
  ImageWithoutUsablePose,  ///< an image whose rotation or position is no such thing: not registered
  PointNotFinite,          ///< a point at infinity or nowhere: left out
  PointErrorNotFinite,     ///< a point whose stored error is not a number: set to unknown
  ObservationNotFinite,    ///< an observation that is nowhere in the image: kept at (0, 0), without its point
  ObservationOfMissingPoint,  ///< an observation names a point that is not there: kept, without a point
  TrackOfMissingImage,        ///< a track names an image that is not there: left out of the track
  TrackOfUnregisteredImage,   ///< a track names an image without pose: left out of the track
  TrackWithWrongNumber,       ///< a track names an observation that sees another point, or none: left out of the track
  TrackWithRepetition,        ///< a track names an observation twice: once is kept
  ObservationNotInTrack,      ///< an observation names a point whose track does not list it: listed
  ObservationWithoutId,       ///< an image names no points at all, although tracks list its observations: taken from the tracks
  FrameOfMissingImage,        ///< a frame names an image that is not there: left out of the frame
  RigOrFrameInvalid,          ///< a rig, or a frame, that refers to things that are not there: left out
  FrameContradictsImage,      ///< a frame's pose differs from that of its image: the image's is used
  OriginOfImagePositions,     ///< image positions count from another origin than the format says: principal points moved
};

/// How many there are.
constexpr std::size_t kMendCount = static_cast<std::size_t>(Mend::OriginOfImagePositions) + 1;

/// What kind of thing is mended, and how, in words: "tracks name an image that is not there: left out of the track".
HYBRIDGV_EXPORT const char* toString(Mend mend);

/// What a reader has mended.
struct HYBRIDGV_EXPORT ReadReport {
  /// How often, by kind.
  std::array<std::size_t, kMendCount> counts{};
  /// The first place of every kind, as in FileError ("FILE:LINE: reason"); empty if there is none.
  std::array<std::string, kMendCount> firstPlaces;
  /// Other things that a user should know: which model of a project folder was read.
  std::vector<std::string> notes;
  /// Median distance [px] between the observations and the projections of their points, -1 if it was not measured (fewer than 20
  /// observations, or not wanted).
  double medianErrorPx = -1;

  /// How often something of this kind was mended.
  std::size_t count(Mend mend) const { return counts[static_cast<std::size_t>(mend)]; }
  /// True if there is nothing to tell.
  bool isEmpty() const;
  /// One sentence for each note and each kind of mend, with its number and first place.
  std::vector<std::string> sentences() const;
};

/// How a reader deals with faults.
struct ReadOptions {
  /// True: the first fault that would be mended is a FileError.
  bool strict = false;
  /// Refuse (FileError) a map that contradicts itself: whose stored points miss their observations by many pixels in the median,
  /// because image size, principal point or focal length are not those of the observations. Image positions that merely count
  /// from another origin are mended. False: nothing is compared.
  bool checkConsistency = true;
};

}  // namespace sfm
}  // namespace hybridgv
