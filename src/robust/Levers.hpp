// Rays that could decide about the pose alone.
#pragma once

#include <vector>

#include "correspondences/PaddedValues.hpp"
#include "robust/LeastSquares.hpp"

namespace hybridgv {
namespace robust {

// What keeps single rays from deciding: narrowed losses (RayArrays::narrowing), and rays that are left out altogether, because the
// others do not predict them.
class RayTreatment {
 public:
  explicit RayTreatment(std::size_t rays) : narrowing_(rays, 1) {}

  void refuse(const std::vector<std::size_t>& rays);
  void setNarrowing(std::vector<double> narrowing);
  const std::vector<std::size_t>& refused() const { return refused_; }
  // Makes the squared errors of the refused rays infinite.
  void leaveOut(std::vector<double>& squaredErrors) const;
  // The narrowing for LeastSquaresProblem, null if there is nothing to do.
  correspondences::PaddedValues narrowing() const;

 private:
  std::vector<double> narrowing_;
  std::vector<std::size_t> refused_;
  bool isNeeded_ = false;
};

struct Levers {
  std::vector<std::size_t> rays;
  std::vector<double> leverages;  // of all rays, while none of them is left out
  ParameterMatrix others;         // information of the rest
};

// The rays of which the leverage (Leverage.hpp) exceeds one half. Levers that lie near to each other hide each other, so those that
// stand out when the first ones are left out are among them. The problem's narrowing is that of the treatment.
Levers leversOf(const LeastSquaresProblem& problem, const QueryPose& pose, RayTreatment treatment);
// The same where the information, with all levers, is known.
Levers leversOf(const LeastSquaresProblem& problem, const QueryPose& pose, RayTreatment treatment, ParameterMatrix information);

}  // namespace robust
}  // namespace hybridgv
