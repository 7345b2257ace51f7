// How many samples are worth drawing from few correspondences.
#pragma once

#include <vector>

#include "robust/ChanceModel.hpp"
#include "robust/Sampler.hpp"
#include "robust/SolverChoice.hpp"

namespace hybridgv {
namespace robust {

// How many different samples of this size there are.
double numberOfSamples(const Sampler& sampler, const SampleSize& size);

// As many draws as let nearly every sample be drawn once. `variants`: how many solutions of one sample differ by what is drawn
// beside it (a distortion).
double drawsOfAllSamples(const Sampler& sampler, const std::vector<Strategy>& strategies, std::size_t variants);

// Whether not even a pose with which all correspondences agree exactly would be more than chance.
bool isHopeless(const Sampler& sampler, const ChanceModel& chance, int parameters);

}  // namespace robust
}  // namespace hybridgv
