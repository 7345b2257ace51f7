// Thresholds in steps of two: T, T/2, T/4, .. of each kind.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "robust/PerKind.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

using LevelCounts = std::array<int, kLevels>;
using LevelShares = std::array<double, kLevels>;
using Shares = PerKind<LevelShares>;

// Number of errors below each threshold. `squaredThreshold`: T^2.
LevelCounts countLevels(const double* squaredErrors, std::size_t size, double squaredThreshold);

// T of the level.
double thresholdAt(double threshold, int level);
// The level of a threshold, of which this is the multiple of T: one of thresholdAt(1, level).
std::size_t levelOf(double scale);

// At each level and of each kind.
Shares largest(const Shares& a, const Shares& b);
Shares meanOf(const std::vector<Shares>& shares);

// The level at which the inliers exceed most clearly what chance gives: with x the excess over the expected m, the largest
// x^2 / (m + 0.3 x), a measure of Chernoff's bound that needs no logarithm. `fitted`: so many are inliers by construction.
int clearestLevel(const LevelCounts& counts, std::size_t all, const LevelShares& chance, int fitted);

}  // namespace robust
}  // namespace hybridgv
