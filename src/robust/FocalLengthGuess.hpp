// The focal length for minimal solvers that do not find it.
#pragma once

#include "math/RandomStream.hpp"

namespace hybridgv {
namespace robust {

// Where the focal length is unknown, samples are solved with a guess of their own: distance and focal length have almost the same
// effect on the images, so that a pose at a wrong focal length stands at the right place for it, and the refinement, which estimates
// the focal length, leads from there to the optimum. A sample of three points needs one inlier less than one that determines the
// focal length, and noise that is amplified in a poorly determined focal length does not carry the pose away.
//
// Too long a guess is nearly harmless, too short a one is not: there the pose stands so near that points are behind it.
class FocalLengthGuess {
 public:
  // Around the image's size, or any other length near the focal length: 2^-0.5 to 2^1.5 times as long.
  static FocalLengthGuess around(double imageSize, double least, double most);

  // Around a focal length that is known up to this standard deviation of its logarithm.
  static FocalLengthGuess near(double focalLength, double logDeviation, double least, double most);
  // Always this one.
  static FocalLengthGuess exactly(double focalLength) { return {focalLength, 0, focalLength, focalLength}; }

  double draw(math::RandomStream& random) const;

 private:
  FocalLengthGuess(double middle, double octaves, double least, double most)
      : middle_(middle), octaves_(octaves), least_(least), most_(most) {}

  double middle_, octaves_;  // 2^(-octaves) to 2^octaves times the middle, evenly in the logarithm
  double least_, most_;
};

}  // namespace robust
}  // namespace hybridgv
