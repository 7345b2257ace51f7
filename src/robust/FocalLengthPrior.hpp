// What is known of the focal length before anything is seen, from EXIF for example.
#pragma once

namespace hybridgv {
namespace robust {

// The logarithm of the focal length has Student's distribution with 3 degrees of freedom, x = log(f / focalLength) / logDeviation. Such
// a prior gives way where the data contradict it, as a normal one would not: what is stored in an image may be wrong altogether.
struct FocalLengthPrior {
  bool isGiven() const { return logDeviation > 0; }
  // -2 log of the likelihood, 0 at the middle; and without a prior.
  double cost(double focalLengthOfPose) const;
  // The derivative of half the cost by log f is weight times log(f / focalLength); information that is never negative.
  double weight(double focalLengthOfPose) const;
  // log10 of how much denser the prior is at f than it is for wrong poses, whose focal lengths are spread evenly over a factor of 30 in
  // the logarithm. An f that contradicts the prior does not speak against a pose by more than a factor of 20.
  double logOdds(double focalLengthOfPose) const;
  // log(f / focalLength), 0 without a prior.
  double logDifference(double focalLengthOfPose) const;

  double focalLength = 0;   // [px]
  double logDeviation = 0;  // 0: no prior
  double factor = 1;        // for costs that are smaller than -2 log of the likelihood
};

}  // namespace robust
}  // namespace hybridgv
