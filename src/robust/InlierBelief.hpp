// What is believed of the shares of inliers before a pose is found.
#pragma once

#include <cstddef>
#include <vector>

namespace hybridgv {
namespace robust {

// The shares of inliers among the rays (w2) and the points (w3) are unknown, all values on a grid alike, and as likely equal as not: what
// spoils one kind of match often spoils the other. A sample of m rays and n points that has failed is no surprise where w2^m w3^n is
// small, so that failures speak for small shares, and small shares for samples of few correspondences.
class InlierBelief {
 public:
  // The correspondences of a sample on which its success depends.
  struct SampleKind {
    int rays, points;
    double yield;  // of the samples with inliers only, the share that leads to a pose which is believed
  };
  explicit InlierBelief(const std::vector<SampleKind>& samples);

  // For each kind of sample the probability that the next one succeeds, after so many failures of each.
  std::vector<double> successProbabilities(const std::vector<int>& failures) const;

 private:
  std::size_t kinds_;
  std::vector<double> logPrior_;              // of each cell of the grid
  std::vector<double> success_, logFailure_;  // of each cell, and in it of each kind of sample
};

}  // namespace robust
}  // namespace hybridgv
