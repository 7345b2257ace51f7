// The memory that hybridRansac takes, counted by a replaced operator new: a program of its own.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "HybridScene.hpp"
#include "Random.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace {

std::atomic<std::size_t> live{0}, peak{0};
constexpr std::size_t kHeader = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t size) {
  void* block = std::malloc(size + kHeader);
  if (block == nullptr) throw std::bad_alloc();
  *static_cast<std::size_t*>(block) = size;
  const std::size_t now = live += size;
  std::size_t before = peak;
  while (before < now && !peak.compare_exchange_weak(before, now)) {
  }
  return static_cast<char*>(block) + kHeader;
}
// std::stable_sort allocates with this one. A sanitizer's would not come to the one above.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  if (memory == nullptr) return;
  void* block = static_cast<char*>(memory) - kHeader;
  live -= *static_cast<std::size_t*>(block);
  std::free(block);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { operator delete(memory); }

namespace hybridgv {
namespace {

// Peak of a search that finds nothing.
std::size_t peakOfSearch(int iterations, int threads) {
  test::Random random(test::testSeed(), 120);
  test::SceneOptions sceneOptions;
  sceneOptions.rays = 0;
  sceneOptions.points = 50;  // with fewer it would end before
  sceneOptions.outlierSharePoints = 1;
  const NoncentralHybridAdapter adapter = test::makeHybridScene(random, sceneOptions).adapter();
  sac::HybridRansacOptions options;
  options.maxReprojectionErrorPx = 1;
  options.maxIterations = iterations;
  options.threads = threads;
  peak = live.load();
  const std::size_t before = live;
  const sac::HybridRansacResult result = sac::hybridRansac(adapter, options);
  EXPECT_EQ(result.iterations, iterations);
  return peak - before;
}

TEST(SearchMemory, DoesNotGrowWithTheNumberOfSamples) {
  for (const int threads : {1, 2}) {
    const std::size_t few = peakOfSearch(2000, threads), many = peakOfSearch(100000, threads);
    EXPECT_GT(few, 1000u);  // else nothing is counted
    // A solution that looks promising makes the search ask other pairs, which are made once; a byte for each sample would be more.
    constexpr std::size_t kMadeOnce = 60000;
    EXPECT_LE(many, few + kMadeOnce);
  }
}

}  // namespace
}  // namespace hybridgv
