#include "robust/HybridSearch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "robust/Overlap.hpp"
#include "robust/SampleCheck.hpp"
#include "robust/imageBox.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Batches grow, because what was learnt from one steers the next: to 128 samples, then with a quarter of all before.
constexpr int kFirstBatch = 8, kLeastBatch = 8, kLargestBatch = 128, kLargestPart = 4;

constexpr int kSamplesIfHopeless = 24;

// Samples of a batch whose solutions tell how correspondences crowd.
constexpr int kAskedOfBatch = 64;

int largestBatch(int iterations) { return std::max(kLargestBatch, iterations / kLargestPart); }

// A pose from a minimal sample has less inliers than its optimum: the share of them that is tested for. One that has them all is given
// up by mistake so often.
constexpr double kUnoptimizedShare = 0.5, kGivenUp = kFalseRejection * kFalseRejection;

double chosenOf(const std::vector<double>& values, RandomStream& random) {
  return values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
}

FocalLengthKnowledge knowledgeOf(const sac::HybridRansacOptions& options) {
  if (options.knownFocalLengthPx) return FocalLengthKnowledge::Exact;
  return options.focalLengthPriorPx ? FocalLengthKnowledge::Prior : FocalLengthKnowledge::None;
}

FocalLengthPrior makePrior(const sac::HybridRansacOptions& options) {
  if (!options.focalLengthPriorPx) return {};
  return {*options.focalLengthPriorPx, options.focalLengthPriorLogDeviation};
}

double mostLogOdds(const sac::HybridRansacOptions& options) {
  const FocalLengthPrior prior = makePrior(options);
  return prior.logOdds(prior.focalLength);
}

// If the user does not say: hardly a pinhole image shows more than 136 degrees, and the image is at least as large as what its points fill. Rays
// that tell little of the focal length may well agree with ever smaller ones, from ever nearer. Whoever allows no much larger ones, or starts
// from there, means it.
double leastFocalLength(const sac::HybridRansacOptions& options, const CorrespondenceArrays& arrays) {
  constexpr double kOfImage = 0.2, kMuchLarger = 2;
  if (options.minFocalLength > 0 || options.knownFocalLengthPx || options.focalLengthPriorPx) return options.minFocalLength;
  const double least = kOfImage * arrays.leastImageSize();
  const double meant = options.initialPose ? options.initialPose->focalLength : options.maxFocalLength;
  return kMuchLarger * least < std::min(meant, options.maxFocalLength) ? least : 0;
}

FocalLengthGuess makeGuess(const sac::HybridRansacOptions& options, double least, const CorrespondenceArrays& arrays) {
  if (options.knownFocalLengthPx) return FocalLengthGuess::exactly(*options.knownFocalLengthPx);
  const double most = options.maxFocalLength;
  const FocalLengthPrior prior = makePrior(options);
  return prior.isGiven() ? FocalLengthGuess::near(prior.focalLength, prior.logDeviation, least, most)
                         : FocalLengthGuess::around(arrays.imageSize(), least, most);
}

}  // namespace

std::size_t workersFor(const sac::HybridRansacOptions& options) {
  return numberOfWorkers(options.threads, std::min(options.maxIterations, largestBatch(options.maxIterations)));
}

HybridSearch::HybridSearch(SearchData all, std::optional<SearchData> part, const sac::HybridRansacOptions& options,
                           WorkerPool& workers, Clock::time_point start)
    : options_(options),
      start_(start),
      all_(std::move(all)),
      part_(std::move(part)),
      data_(part_ ? *part_ : all_),
      lens_(makeLens(data_.arrays, options)),
      estimated_{!options.knownFocalLengthPx, lens_.isUnknown},
      choice_(makeStrategies(options.solvers, data_.sampler, knowledgeOf(options))),
      leastFocalLength_(leastFocalLength(options, data_.arrays)),
      guess_(makeGuess(options, leastFocalLength_, data_.arrays)),
      image_(imageBox(data_.arrays)),
      scorer_(
          data_.arrays,
          thresholdBounds({options.maxEpipolarErrorPx, options.maxReprojectionErrorPx}, roughlyKnownFocalLength(options), image_),
          options.scoring),
      chance_(data_.arrays, image_, scorer_.bounds().rays, scorer_.bounds().points),
      chanceShares_(chance_.levelShares()),
      features_(data_.arrays),
      significance_(scorer_, chance_, data_.sampler, features_, workers, estimated_.parameters(), options.seed),
      optimizer_(makeOptimizer(scorer_, chance_, features_)),
      workers_(workers),
      workerStates_(workers_.size()),
      ofThreePointsAtFirst_(findable()) {
  optimizer_.setWorkers(workers_);
  significance_.setFocalLengthPrior(makePrior(options));
  for (WorkerState& worker : workerStates_) worker.draws.resize(choice_.strategies().size());
  const auto isStaged = [](const Strategy& strategy) { return strategy.isStaged(); };
  if (std::any_of(choice_.strategies().begin(), choice_.strategies().end(), isStaged)) staged_.emplace(data_);
  mostIterations_ = mostIterations();
  if (part_) workers_.beginTask([this] { featuresOfAll_.emplace(all_.arrays); });
}

HybridSearch::~HybridSearch() {
  if (part_) workers_.dropTask();
}

// For the scorer's correspondences.
LocalOptimizer HybridSearch::makeOptimizer(const PoseScorer& scorer, const ChanceModel& chance,
                                           const QueryFeatures& features) const {
  return {scorer, chance, features, leastFocalLength_, options_.maxFocalLength, estimated_, lens_, makePrior(options_)};
}

std::size_t HybridSearch::variants() const { return lens_.isUnknown ? lens_.hypotheses.size() : 1; }

// No more samples than there are. If not even a pose with which all correspondences agree could be relied on, a few are enough.
int HybridSearch::mostIterations() const {
  double most = drawsOfAllSamples(data_.sampler, choice_.strategies(), variants());
  if (isHopeless(data_.sampler, chance_, estimated_.parameters(), mostLogOdds(options_)))
    most = std::min(most, static_cast<double>(kSamplesIfHopeless));
  return static_cast<int>(std::min(std::ceil(std::max(most, 1.)), static_cast<double>(options_.maxIterations)));
}

int HybridSearch::leastIterations() const {
  constexpr double kWithUnknownLens = 4, kWithKnownFocalLength = 1. / 3;
  const double factor = lens_.isUnknown ? kWithUnknownLens : options_.knownFocalLengthPx ? kWithKnownFocalLength : 1;
  return static_cast<int>(std::min(std::ceil(factor * options_.minIterations), static_cast<double>(mostIterations_)));
}

bool HybridSearch::lacksScale() const {
  const Sampler& sampler = data_.sampler;
  return sampler.numberPoints() == 0 && sampler.numberCameras() == 1 && sampler.numberRays() >= estimated_.parameters();
}

void HybridSearch::run() {
  if (options_.initialPose) tryInitialPose();
  if (choice_.strategies().empty()) return;
  for (int batch = kFirstBatch; !isDone(); batch = nextBatch(batch)) tryBatch(std::min(batch, mostIterations_ - iterations_));
}

// The last one ends where the search does.
int HybridSearch::nextBatch(int batch) const {
  const int next = std::min(2 * batch, largestBatch(iterations_));
  if (!bestIsSignificant_) return next;
  const double needed = std::ceil(choice_.samplesUntil(1 - options_.successProbability)) + 1;
  const double wanted =
      std::max({needed, static_cast<double>(leastIterations() - iterations_), static_cast<double>(kLeastBatch)});
  return static_cast<int>(std::min(static_cast<double>(next), wanted));
}

void HybridSearch::tryInitialPose() {
  Model model;
  model.pose = data_.arrays.normalization().apply(*options_.initialPose);
  if (options_.knownFocalLengthPx) model.pose.focalLength = *options_.knownFocalLengthPx;
  SquaredErrors errors;
  model.evaluation = scorer_.evaluateAtClearestLevels(model.pose, chanceShares_, errors);
  model.evaluation.score = scorer_.score(model.evaluation, errors);
  if (model.evaluation.score > 0) consider(model);
}

void HybridSearch::tryBatch(int count) {
  for (WorkerState& worker : workerStates_) {
    std::fill(worker.draws.begin(), worker.draws.end(), 0);
    if (staged_) worker.ownScores = staged_->noScores();
    worker.best.reset();
    worker.promising.clear();
  }
  workers_.forEach(count, [&](int i, std::size_t worker) {
    if (!isOutOfTime()) tryHypothesis(iterations_ + i + 1, workerStates_[worker]);
  });
  for (WorkerState& worker : workerStates_) solveGathered(worker);
  std::optional<Candidate> best;
  for (const WorkerState& worker : workerStates_) {
    iterations_ += std::accumulate(worker.draws.begin(), worker.draws.end(), 0);
    for (std::size_t s = 0; s < worker.draws.size(); ++s) choice_.addDraws(s, worker.draws[s]);
    if (staged_) staged_->learn(worker.ownScores);
    if (worker.best && (!best || worker.best->isLessLikelyChance(*best))) best = worker.best;
  }
  significance_.setSamples(iterations_);
  if (best && isWorthConsidering(*best)) consider(best->model);
  if (best && !bestIsSignificant_ && !asksPairs_ && significance_.isPromising(best->logChance)) learnFromPairs(*best);
  if (!bestIsSignificant_) choice_.learnFromFailures();
}

// Of minimal solutions the one is best that is least likely chance. Their scores do not tell, because an inlier of one kind can
// be much less of an accident than one of the other.
bool HybridSearch::Candidate::isLessLikelyChance(const Candidate& other) const {
  if (logChance != other.logChance) return logChance < other.logChance;
  if (model.evaluation.score != other.model.evaluation.score) return model.evaluation.score > other.model.evaluation.score;
  return number < other.number;
}

// If less than one wrong pose of those tried so far is expected to look as good: it may lead to another optimum than the best pose's.
// Or, as long as no pose is believed, if it is the best minimal solution so far.
bool HybridSearch::isWorthConsidering(const Candidate& candidate) {
  const bool isPromising = significance_.isPromising(candidate.logChance);
  const bool pairsMustAgree = promisingOnly_ || (asksPairs_ && bestIsSignificant_);
  if (pairsMustAgree && !(isPromising && significance_.isPromising(candidate.model.pose))) return false;
  if (bestIsSignificant_ || promisingOnly_) return isPromising && !leadsToBest(candidate.model.pose);
  const bool isBest = !bestCandidate_ || candidate.isLessLikelyChance(*bestCandidate_);
  if (isBest) bestCandidate_ = candidate;
  return isPromising || isBest;
}

// With a known focal length there are no optima along distance and focal length (escapeLocalOptimum): a pose whose inliers are the best
// one's, but for a few, leads to the same optimum. Where most correspondences agree with the best one, its inliers are those near it, too: a pose
// from a minimal sample has others than its optimum.
bool HybridSearch::leadsToBest(const QueryPose& pose) const {
  if (!bestIsSignificant_ || !options_.localOptimization || estimated_.focalLength || estimated_.radial) return false;
  constexpr double kNew = 0.1, kMost = 0.5, kNear = 2;
  const Evaluation& best = best_.evaluation;
  const int all = data_.sampler.numberRays() + data_.sampler.numberPoints();
  const double factor = best.rays + best.points > kMost * all ? kNear : 1;
  const PerKind<double>& thresholds = scorer_.thresholds();
  const InlierMasks near = scorer_.within({factor * thresholds.rays, factor * thresholds.points}, best_.pose);
  const Overlap inliers = overlap(near, scorer_.inliers(pose));
  return inliers.onlySecond < kNew * inliers.both;
}

void HybridSearch::tryHypothesis(int number, WorkerState& worker) const {
  RandomStream random(options_.seed, static_cast<std::uint64_t>(number));
  const std::size_t chosen = choice_.choose(random.uniform());
  ++worker.draws[chosen];
  Hypothesis hypothesis;
  hypothesis.number = number;
  hypothesis.strategy = &choice_.strategies()[chosen];
  hypothesis.sample = data_.sampler.draw(hypothesis.strategy->size(), number, random);
  hypothesis.distortion = lens_.isUnknown ? chosenOf(lens_.hypotheses, random) : 0;
  const SampleReader reader(data_.arrays, hypothesis.distortion);
  const int found = solve(hypothesis, reader, random, worker);
  considerSolutions(hypothesis, worker.solutions.data(), found, worker);
}

int HybridSearch::solve(const Hypothesis& hypothesis, const SampleReader& reader, RandomStream& random,
                        WorkerState& worker) const {
  const Strategy& strategy = *hypothesis.strategy;
  const DrawnSample& sample = hypothesis.sample;
  const SampleSize size = strategy.size();
  correspondences::RayMatch rays[kMaxSampleSize];
  correspondences::PointMatch points[kMaxSampleSize];
  for (int k = 0; k < size.rays; ++k) rays[k] = reader.ray(sample.rays[k]);
  for (int k = 0; k < size.points; ++k) points[k] = reader.point(sample.points[k]);
  if (isDegenerate(rays, size.rays, points, size.points)) return 0;
  FocalPose* poses = worker.solutions.data();
  if (strategy.isStaged()) return staged_->solve(sample, reader, scorer_.thresholds().rays, random, poses, worker.ownScores);
  const double focalLength = focalLengthOf(strategy, random);
  if (strategy.solver.solveMany == nullptr) return solvers::solve(strategy.solver, rays, points, focalLength, poses);
  if (worker.gathered.isFull() || !worker.gathered.takes(strategy)) solveGathered(worker);
  worker.gathered.add(hypothesis, points, focalLength);
  return 0;
}

// The unit, for a solver that estimates it.
double HybridSearch::focalLengthOf(const Strategy& strategy, RandomStream& random) const {
  return strategy.solver.intrinsics.focalLength ? 1 : guess_.draw(random);
}

void HybridSearch::solveGathered(WorkerState& worker) const {
  GatheredSamples& samples = worker.gathered;
  int found[solvers::kSideBySide];
  samples.solve(worker.solutions.data(), found);
  for (int i = 0; i < samples.count(); ++i)
    considerSolutions(samples[i], worker.solutions.data() + i * samples[i].strategy->solver.maxSolutions, found[i], worker);
  samples.clear();
}

void HybridSearch::considerSolutions(const Hypothesis& hypothesis, const FocalPose* poses, int count, WorkerState& worker) const {
  const Strategy& strategy = *hypothesis.strategy;
  const OwnCorrespondences own{{hypothesis.sample.rays, hypothesis.sample.points},
                               {strategy.solver.rays, strategy.solver.points}};
  for (int k = 0; k < count; ++k) {
    QueryPose solution = poses[k];
    solution.distortion = hypothesis.distortion;
    considerSolution(solution, strategy, own, hypothesis.number, worker);
  }
}

// Before anything is known of the data, a pose from three points must be seen by as large a share of the other points as is needed for
// a few such samples to be found at all. Most wrong poses are told so without a look at the rays.
//
// The bound of the errors may be much too large for that: the threshold is one within which a wrong pose has a thousandth of the points.
double HybridSearch::firstScale() const {
  constexpr double kShare = 1e-3;
  return std::min(std::sqrt(kShare / chance_.pointShare()), 1.0);
}

Expectation HybridSearch::findable() const {
  constexpr double kFindableShare = 0.07, kFew = 3;
  const double share = kUnoptimizedShare * std::min(std::cbrt(kFew / options_.maxIterations), kFindableShare);
  return {{0, share}, {0, chance_.pointShare(firstScale())}};
}

Evaluation HybridSearch::evaluate(const QueryPose& pose, const Strategy& strategy, const OwnCorrespondences& own,
                                  WorkerState& worker) const {
  if (bestIsSignificant_) return scorer_.evaluate(pose, expectation_, own);
  if (strategy.solver.points >= 3 && !scorer_.pointsLeaveHope(pose, firstScale(), ofThreePointsAtFirst_, own)) return {};
  return scorer_.evaluateAtClearestLevels(pose, chanceShares_, worker.errors);
}

void HybridSearch::considerSolution(const QueryPose& pose, const Strategy& strategy, const OwnCorrespondences& own, int number,
                                    WorkerState& worker) const {
  if (!(pose.focalLength >= leastFocalLength_ && pose.focalLength <= options_.maxFocalLength)) return;
  Candidate candidate;
  candidate.number = number;
  candidate.model.solver = strategy.solver.id;
  candidate.model.pose = pose;
  candidate.model.evaluation = evaluate(pose, strategy, own, worker);
  if (!candidate.model.evaluation.complete) return;
  if (bestIsSignificant_)
    candidate.logChance = significance_.logChance(candidate.model.evaluation);
  else if (!rate(candidate, worker))
    return;
  if (!worker.best || candidate.isLessLikelyChance(*worker.best)) worker.best = candidate;
}

// As long as no pose is believed. False if the solution is of no interest. What is worse than the best one anyway needs no score.
bool HybridSearch::rate(Candidate& candidate, WorkerState& worker) const {
  Evaluation& evaluation = candidate.model.evaluation;
  const auto isWorse = [&] { return worker.best && candidate.logChance > worker.best->logChance; };
  candidate.logChance = significance_.logChance(evaluation, chanceShares_);
  const bool isPromising = significance_.isPromising(candidate.logChance);
  const bool isWorseThanBefore = bestCandidate_ && candidate.logChance > bestCandidate_->logChance;
  if (!isPromising && (promisingOnly_ || isWorseThanBefore)) return false;
  if (!asksPairs_ && candidate.number <= iterations_ + kAskedOfBatch && isPromising)
    worker.promising.push_back({candidate.number, candidate.model.pose});
  if (asksPairs_ && !isWorse()) rateByPairs(candidate, worker);
  if (!isWorse()) evaluation.score = scorer_.score(evaluation, worker.errors);
  return true;
}

// Which is slower, and only makes it likelier to be chance.
void HybridSearch::rateByPairs(Candidate& candidate, WorkerState& worker) const {
  Evaluation& evaluation = candidate.model.evaluation;
  const Shares shares = largest(chanceShares_, significance_.sharesOfPairs(candidate.model.pose));
  evaluation = scorer_.evaluateAtClearestLevels(candidate.model.pose, shares, worker.errors);
  candidate.logChance = std::max(candidate.logChance, significance_.logChance(evaluation, shares));
}

// A solution looked promising, and is not believed (or, in the search for a second pose, not promising by other pairs either). Where correspondences
// crowd, all the best ones may be of that kind, those from which much of the map is seen in one place. From now on they are rated by what other
// pairs say.
void HybridSearch::learnFromPairs(const Candidate& notBelieved) {
  asksPairs_ = true;
  bestCandidate_.reset();
  significance_.preparePairs();
  std::vector<NumberedPose> asked;
  for (const WorkerState& worker : workerStates_) asked.insert(asked.end(), worker.promising.begin(), worker.promising.end());
  if (asked.empty()) asked.push_back({notBelieved.number, notBelieved.model.pose});
  std::stable_sort(asked.begin(), asked.end(), [](const NumberedPose& a, const NumberedPose& b) { return a.number < b.number; });
  std::vector<Shares> shares;
  for (const NumberedPose& solution : asked) shares.push_back(significance_.sharesOfPairs(solution.pose));
  chanceShares_ = largest(chanceShares_, meanOf(shares));
}

void HybridSearch::consider(const Model& candidate) {
  Model optimized = candidate;
  setThresholds(optimized);
  if (options_.localOptimization) {
    optimized.logLikelihood = optimizer_.logLikelihood(candidate.pose);
    ++localOptimizations_;
    replaceIfLikelier(optimizer_.refine(candidate.pose), optimized);
    findThresholds(optimized);
  }
  compare(optimized);
  setThresholds(best_);
}

// The optimized model against the best one.
void HybridSearch::compare(const Model& optimized) {
  // A model that is believed is replaced by a likelier one only.
  if (bestIsSignificant_ && options_.localOptimization && !(optimized.logLikelihood > best_.logLikelihood)) return;
  const bool isSignificant = significance_.isSignificant(optimized.pose);
  if (isBetter(optimized, isSignificant)) setBest(optimized, isSignificant);
}

// The thresholds of a model's evaluation become those of the search.
void HybridSearch::setThresholds(const Model& model) {
  const PerKind<double>&bounds = scorer_.bounds(), &scale = model.evaluation.scale;
  scorer_.setThresholds({scale.rays * bounds.rays, scale.points * bounds.points});
}

Thresholds HybridSearch::thresholdsAt(const QueryPose& pose) const {
  const SquaredErrors errors{scorer_.squaredRayErrors(pose), scorer_.squaredPointErrors(pose)};
  return workingThresholds(errors, scorer_.bounds(), chance_);
}

// The model is evaluated, and the search goes on, with the thresholds that its errors ask for.
void HybridSearch::findThresholds(Model& model) {
  scorer_.setThresholds(thresholdsAt(model.pose));
  model.evaluation = scorer_.evaluate(model.pose);
  model.logLikelihood = optimizer_.logLikelihood(model.pose);
}

// A pose that is more than chance is better than one that is not; of optimized ones the likelier, otherwise the score decides.
bool HybridSearch::isBetter(const Model& model, bool isSignificant) const {
  if (isSignificant != bestIsSignificant_) return isSignificant;
  if (options_.localOptimization && hasModel()) return model.logLikelihood > best_.logLikelihood;
  return model.evaluation.score > best_.evaluation.score;
}

void HybridSearch::replaceIfLikelier(const QueryPose& pose, Model& model) const {
  const double logLikelihood = optimizer_.logLikelihood(pose);
  if (!(logLikelihood > model.logLikelihood)) return;
  model.pose = pose;
  model.logLikelihood = logLikelihood;
  model.evaluation = scorer_.evaluate(pose);
}

void HybridSearch::setBest(const Model& model, bool isSignificant) {
  best_ = model;
  bestIsSignificant_ = isSignificant;
  if (bestIsSignificant_) learnFrom(model);
}

// What the search expects from now on: of samples, and of poses worth keeping.
void HybridSearch::learnFrom(const Model& model) {
  // A right correspondence beyond the threshold, 2.5 deviations of the noise, makes a sample good, too.
  constexpr double kWider = 1.5;
  const InlierCounts usable = inlierCounts(model.pose, kWider);
  std::vector<double> probabilities;
  for (const Strategy& strategy : choice_.strategies())
    probabilities.push_back((1 - kGivenUp) * strategy.yield() * data_.sampler.allInlierProbability(strategy.size(), usable));
  choice_.setAllInlierProbabilities(probabilities);

  const auto share = [](int part, int all) { return all > 0 ? std::min(kUnoptimizedShare * part / all, 0.9) : 0; };
  const InlierCounts inliers = inlierCounts(model.pose);
  const PerKind<double> good{share(inliers.rays, data_.sampler.numberRays()),
                             share(inliers.points, data_.sampler.numberPoints())};
  const PerKind<double> scale = scorer_.scale();
  expectation_ = Expectation(good, {chance_.rayShare(scale.rays), chance_.pointShare(scale.points)});
}

InlierCounts HybridSearch::inlierCounts(const QueryPose& pose, double factor) const {
  const PerKind<std::vector<char>> inliers = scorer_.inliers(pose, factor);
  return data_.sampler.count(inliers.rays, inliers.points);
}

bool HybridSearch::isOutOfTime() const {
  return std::isfinite(options_.timeBudgetSeconds) &&
         std::chrono::duration<double>(Clock::now() - start_).count() > options_.timeBudgetSeconds;
}

// Nothing has been found in a few correspondences.
bool HybridSearch::hasMissedNothing() {
  constexpr int kWorthAsking = 128;
  const bool areFew = data_.sampler.numberPoints() <= LeastSupports::kMostPoints;
  if (bestIsSignificant_ || iterations_ < kWorthAsking || !areFew) return false;
  if (!leastSupports_)
    leastSupports_.emplace(data_.sampler, choice_.strategies(), variants(), chance_, estimated_.parameters(),
                           mostLogOdds(options_));
  return leastSupports_->missProbability(choice_.drawn()) < 1 - options_.successProbability;
}

bool HybridSearch::isDone() {
  if (isOutOfTime()) {
    stopReason_ = sac::StopReason::TimeBudget;
  } else if (iterations_ >= mostIterations_) {
    stopReason_ = mostIterations_ < options_.maxIterations ? sac::StopReason::NoMoreSamples : sac::StopReason::MaxIterations;
  } else if (bestIsSignificant_ && iterations_ >= leastIterations() &&
             choice_.missProbability() < 1 - options_.successProbability) {
    stopReason_ = sac::StopReason::Confident;
  } else if (hasMissedNothing()) {
    stopReason_ = sac::StopReason::NoMoreSamples;
  }
  return stopReason_ != sac::StopReason::NotStarted;
}

}  // namespace robust
}  // namespace hybridgv
