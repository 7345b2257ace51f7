#include "robust/Sampler.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace hybridgv {
namespace robust {
namespace {

int size(const std::vector<int>& list) { return static_cast<int>(list.size()); }

// `count` different ones of list[0 .. pool-1] (Floyd's algorithm).
void drawDifferent(const std::vector<int>& list, int pool, int count, RandomStream& random, int* sample) {
  int position[kMaxSampleSize];
  for (int k = 0; k < count; ++k) {
    const int last = pool - count + k;
    const int candidate = random.below(last + 1);
    position[k] = std::find(position, position + k, candidate) == position + k ? candidate : last;
    sample[k] = list[static_cast<std::size_t>(position[k])];
  }
}

}  // namespace

double hypergeometricAll(int total, int good, int drawn) {
  double probability = 1;
  for (int i = 0; i < drawn; ++i) probability *= static_cast<double>(std::max(good - i, 0)) / (total - i);
  return probability;
}

Sampler::Sampler(const std::vector<int>& cameraOfRay, std::vector<int> rayOrder, std::vector<int> pointOrder, bool growingPools)
    : rayOrder_(std::move(rayOrder)), pointOrder_(std::move(pointOrder)), growingPools_(growingPools) {
  std::map<int, std::vector<int>> byCamera;
  for (const int ray : rayOrder_) byCamera[cameraOfRay[static_cast<std::size_t>(ray)]].push_back(ray);
  cameraOfRay_.resize(cameraOfRay.size());
  for (auto& entry : byCamera) {
    for (const int ray : entry.second) cameraOfRay_[static_cast<std::size_t>(ray)] = numberCameras();
    raysOfCamera_.push_back(std::move(entry.second));
  }
  listCameras();
}

// All lists together have at most 1 + 1/2 + .. + 1/kMaxSampleSize entries for a ray.
void Sampler::listCameras() {
  for (std::size_t camera = 0; camera < raysOfCamera_.size(); ++camera) {
    const int rays = size(raysOfCamera_[camera]);
    for (int least = 1; least <= std::min(rays, kMaxSampleSize); ++least) {
      CameraList& list = camerasWith_[static_cast<std::size_t>(least)];
      list.cameras.push_back(static_cast<int>(camera));
      list.raysUpTo.push_back(rays + (list.raysUpTo.empty() ? 0 : list.raysUpTo.back()));
    }
  }
}

bool Sampler::canDraw(const SampleSize& sample) const {
  if (sample.rays > kMaxSampleSize || sample.points > kMaxSampleSize) return false;
  if (size(pointOrder_) < sample.points || size(rayOrder_) < sample.rays) return false;
  if (sample.rays == 0) return true;
  if (sample.rayDraw == RayDraw::OneCamera) return !camerasWith(sample.rays).cameras.empty();
  if (sample.rayDraw == RayDraw::AllButOne) return !camerasWith(sample.rays - 1).cameras.empty() && numberCameras() > 1;
  return true;
}

int Sampler::poolSize(int available, int sampleSize, int number) const {
  if (!growingPools_ || number >= kGrowth) return available;
  const double pool = available * std::pow(number / kGrowth, 1.0 / sampleSize);
  return std::clamp(static_cast<int>(std::ceil(pool)), std::min(sampleSize + 1, available), available);
}

DrawnSample Sampler::draw(const SampleSize& wanted, int number, RandomStream& random) const {
  DrawnSample sample;
  const int total = wanted.rays + wanted.points;
  drawDifferent(pointOrder_, poolSize(size(pointOrder_), total, number), wanted.points, random, sample.points);
  switch (wanted.rayDraw) {
    case RayDraw::Uniform:
      drawDifferent(rayOrder_, poolSize(size(rayOrder_), total, number), wanted.rays, random, sample.rays);
      break;
    case RayDraw::OneCamera:
      if (wanted.rays > 0) drawOneCamera(wanted.rays, number, random, sample.rays);
      break;
    case RayDraw::AllButOne:
      drawAllButOne(wanted.rays, number, random, sample.rays);
      break;
    case RayDraw::Spread:
      drawSpread(wanted.rays, number, random, sample.rays);
      break;
  }
  return sample;
}

int Sampler::drawOneCamera(int count, int number, RandomStream& random, int* sample) const {
  const CameraList& list = camerasWith(count);
  const int chosen = random.below(list.raysUpTo.back());
  const auto place = std::upper_bound(list.raysUpTo.begin(), list.raysUpTo.end(), chosen) - list.raysUpTo.begin();
  const int camera = list.cameras[static_cast<std::size_t>(place)];
  const std::vector<int>& rays = raysOf(camera);
  drawDifferent(rays, poolSize(size(rays), count + 1, number), count, random, sample);
  return camera;
}

void Sampler::drawAllButOne(int count, int number, RandomStream& random, int* sample) const {
  const int camera = drawOneCamera(count - 1, number, random, sample);
  sample[count - 1] = drawOfOthers(camera, random);
}

// The rays in the order of their cameras, without those of one.
int Sampler::drawOfOthers(int camera, RandomStream& random) const {
  const std::vector<int>& raysUpTo = camerasWith(1).raysUpTo;
  const int left = size(raysOf(camera)), before = raysUpTo[static_cast<std::size_t>(camera)] - left;
  int chosen = random.below(numberRays() - left);
  if (chosen >= before) chosen += left;
  const auto other = std::upper_bound(raysUpTo.begin(), raysUpTo.end(), chosen) - raysUpTo.begin();
  const std::vector<int>& rays = raysOf(static_cast<int>(other));
  return rays[static_cast<std::size_t>(chosen - (raysUpTo[static_cast<std::size_t>(other)] - size(rays)))];
}

// Round by round: every camera that has rays left gives one, in the last round a random subset of them does.
void Sampler::drawSpread(int count, int number, RandomStream& random, int* sample) const {
  int drawn[kMaxSampleSize] = {};  // the camera of each ray
  for (int round = 1, filled = 0; filled < count; ++round) {
    const std::vector<int>& eligible = camerasWith(round).cameras;
    const int taken = std::min(count - filled, size(eligible));
    drawDifferent(eligible, size(eligible), taken, random, drawn + filled);
    filled += taken;
  }
  for (int* end = drawn; end != drawn + count; ++end) std::rotate(std::upper_bound(drawn, end, *end), end, end + 1);
  for (int first = 0; first < count;) {
    const int rays = static_cast<int>(std::count(drawn + first, drawn + count, drawn[first]));
    const std::vector<int>& list = raysOf(drawn[first]);
    drawDifferent(list, std::max(poolSize(size(list), count + 1, number), rays), rays, random, sample + first);
    first += rays;
  }
}

double Sampler::allInlierProbability(const SampleSize& wanted, const InlierCounts& inliers) const {
  const double points = hypergeometricAll(size(pointOrder_), inliers.points, wanted.points);
  switch (wanted.rayDraw) {
    case RayDraw::Uniform:
      return points * hypergeometricAll(size(rayOrder_), inliers.rays, wanted.rays);
    case RayDraw::OneCamera:
      return points * oneCameraProbability(wanted.rays, inliers);
    case RayDraw::AllButOne:
      return points * allButOneProbability(wanted.rays, wanted.triesOfLastRay, inliers);
    case RayDraw::Spread:
      return points * spreadProbability(wanted.rays, inliers);
  }
  return 0;
}

// The mean of a probability over the cameras that a set of `count` rays of one camera may come from.
template <class Probability>
double Sampler::meanOverCameras(int count, Probability probability) const {
  double sum = 0;
  int total = 0;
  for (std::size_t camera = 0; camera < raysOfCamera_.size(); ++camera) {
    const int rays = size(raysOfCamera_[camera]);
    if (rays < count) continue;
    sum += rays * probability(camera);
    total += rays;
  }
  return total > 0 ? sum / total : 0;
}

double Sampler::oneCameraProbability(int count, const InlierCounts& inliers) const {
  return meanOverCameras(
      count, [&](std::size_t camera) { return hypergeometricAll(numberRays(camera), inliers.raysPerCamera[camera], count); });
}

double Sampler::allButOneProbability(int count, int triesOfLast, const InlierCounts& inliers) const {
  return meanOverCameras(count - 1, [&](std::size_t camera) {
    const int good = inliers.raysPerCamera[camera], others = numberRays() - numberRays(camera);
    const double otherIsGood = hypergeometricAll(others, inliers.rays - good, 1);
    return hypergeometricAll(numberRays(camera), good, count - 1) * (1 - std::pow(1 - otherIsGood, triesOfLast));
  });
}

// In the last round a random subset of m of the K cameras that have rays left gives a ray each. With h the probability that the
// rays of the full rounds are inliers, and r_k the probability that one more of camera k is, the mean over all subsets is
// h e_m(r_1, .., r_K) / binomial(K, m), e_m the elementary symmetric polynomial.
double Sampler::spreadProbability(int count, const InlierCounts& inliers) const {
  int fullRounds = 0, left = count;
  const auto eligible = [&](int round) {
    return static_cast<int>(std::count_if(raysOfCamera_.begin(), raysOfCamera_.end(),
                                          [&](const std::vector<int>& rays) { return size(rays) > round; }));
  };
  while (eligible(fullRounds) <= left && left > 0) left -= eligible(fullRounds++);

  double full = 1, symmetric[kMaxSampleSize + 1] = {1}, subsets = 1;
  for (std::size_t camera = 0; camera < raysOfCamera_.size(); ++camera) {
    const int rays = size(raysOfCamera_[camera]), good = inliers.raysPerCamera[camera];
    full *= hypergeometricAll(rays, good, std::min(rays, fullRounds));
    if (rays <= fullRounds) continue;
    const double oneMore = static_cast<double>(std::max(good - fullRounds, 0)) / (rays - fullRounds);
    for (int m = left; m > 0; --m) symmetric[m] += oneMore * symmetric[m - 1];
  }
  for (int m = 0; m < left; ++m) subsets *= static_cast<double>(eligible(fullRounds) - m) / (m + 1);
  return full * symmetric[left] / subsets;
}

InlierCounts Sampler::count(const std::vector<char>& inlierRays, const std::vector<char>& inlierPoints) const {
  const auto countIn = [](const std::vector<char>& mask, const std::vector<int>& list) {
    return static_cast<int>(
        std::count_if(list.begin(), list.end(), [&](int i) { return mask[static_cast<std::size_t>(i)] != 0; }));
  };
  InlierCounts result;
  result.points = countIn(inlierPoints, pointOrder_);
  for (const std::vector<int>& rays : raysOfCamera_) result.raysPerCamera.push_back(countIn(inlierRays, rays));
  result.rays = std::accumulate(result.raysPerCamera.begin(), result.raysPerCamera.end(), 0);
  return result;
}

}  // namespace robust
}  // namespace hybridgv
