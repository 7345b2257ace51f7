// How many inliers a wrong pose has by chance, and whether a pose has more.
#pragma once

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/Evidence.hpp"
#include "robust/Levels.hpp"
#include "robust/RobustBox.hpp"

namespace hybridgv {
namespace robust {

using correspondences::CorrespondenceArrays;

class ChanceModel {
 public:
  // Outliers are taken as uniform over boxes that hold most of the image points. Then a wrong pose has the share pi T^2 / area of
  // the points as inliers, and of the rays at most the sum over both images of 2 sqrt(2) T diagonal / area: an epipolar line is
  // at most as long as the diagonal, and one of the images has at least half of the squared Sampson error.
  // `image`: the query's box (imageBox).
  ChanceModel(const CorrespondenceArrays& arrays, const RobustBox::Size& image, double maxEpipolarError,
              double maxReprojectionError);
  ChanceModel(const CorrespondenceArrays& arrays, double maxEpipolarError, double maxReprojectionError);

  // `scale`: of the thresholds.
  double rayShare(double scale = 1) const;
  double pointShare(double scale = 1) const;

  Shares levelShares() const;

  // Whether a pose has more inliers of a kind than a wrong one would have.
  bool raysAreMoreThanChance(int inliers, int all, double scale = 1) const;
  bool pointsAreMoreThanChance(int inliers, int all, double scale = 1) const;

  // Upper bound of the log10 of the probability that a wrong pose has at least this support, although it has been fitted:
  // `parameters` of its equations (two per point, one per ray) hold by construction, whichever they are. The shares are those of a
  // wrong pose's inliers.
  static double logProbability(const Support& support, double rayShare, double pointShare, int parameters);

 private:
  double rayShare_, pointShare_;
};

// Upper bound of the natural log of the probability that of n events with probability p each, at least k happen:
// -n KL(k/n, p) (Chernoff).
double logTail(int n, int k, double p);

}  // namespace robust
}  // namespace hybridgv
