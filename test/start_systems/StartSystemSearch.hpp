// The choice of a start system: the shorter the ways from it to the problems, the better. For any family of systems; an object of
// the class Family gives
//   System                        with solutions, a std::vector, and the parameters that belong to them
//   Parameters
//   nearRandomReal()              parameters near those of a random real system
//   changed(system, deviation)    random changes of a system's parameters
//   rounded(parameters)           as the table will have them
//   moveTo(parameters, &system)   moves a system with its solutions; false if one is lost
//   meanSteps(system)             the mean number of steps of each path to a set of training samples
#pragma once

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <vector>

namespace hybridgv {
namespace test {

template <class Family>
class StartSystemSearch {
 public:
  using System = typename Family::System;
  using Parameters = typename Family::Parameters;

  StartSystemSearch(Family& family, const System& known) : family_(family), known_(known) {}

  // The best of so many systems near random real ones, after so many random changes, of which those are kept that are for the better.
  void run(int candidates, int changes) {
    for (int i = 0; i < candidates; ++i) improve(known_, family_.nearRandomReal());
    std::fprintf(stderr, "candidates: %.2f steps per path\n", best_);
    double deviation = 0.05;
    for (int i = 0; i < changes; ++i) {
      const bool better = improve(chosen_, family_.changed(chosen_, deviation));
      deviation = std::min(0.1, std::max(0.01, better ? deviation * 1.3 : deviation * 0.97));
    }
    std::fprintf(stderr, "after %d changes: %.2f\n", changes, best_);
    putLongestFirst();
  }

  const System& chosen() const { return chosen_; }
  double stepsPerPath() const { return best_; }

 private:
  // Keeps the better of the chosen system and the one with the given parameters, to which `from` is moved.
  bool improve(const System& from, const Parameters& parameters) {
    System candidate = from;
    if (!family_.moveTo(family_.rounded(parameters), &candidate)) return false;
    const std::vector<double> steps = family_.meanSteps(candidate);
    const double mean = std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
    if (!(mean < best_)) return false;
    best_ = mean;
    chosen_ = candidate;
    return true;
  }

  // The longest paths first, so that no lane is left alone with one at the end.
  void putLongestFirst() {
    const std::vector<double> length = family_.meanSteps(chosen_);
    std::vector<std::size_t> order(length.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&length](std::size_t a, std::size_t b) { return length[a] > length[b]; });
    const System unsorted = chosen_;
    for (std::size_t i = 0; i < order.size(); ++i) chosen_.solutions[i] = unsorted.solutions[order[i]];
  }

  Family& family_;
  System known_;
  System chosen_;
  double best_ = std::numeric_limits<double>::infinity();
};

}  // namespace test
}  // namespace hybridgv
