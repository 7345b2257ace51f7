// Wrong calls of hybridRansac.
#include "Misuse.hpp"
#include "hybridgv/detail/format.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac::HybridRansacOptions;

TEST(Misuse, RansacRefusesWrongOptions) {
  const struct {
    const char* option;
    std::vector<double> wrong;
    std::function<void(HybridRansacOptions&, double)> set;
  } rows[] = {
      {"maxReprojectionErrorPx",
       {kNaN, kInfinite, -kInfinite, -1, -1e-9, -1e300},
       [](auto& o, double v) { o.maxReprojectionErrorPx = v; }},
      {"maxEpipolarErrorPx", {kNaN, kInfinite, -kInfinite, -1}, [](auto& o, double v) { o.maxEpipolarErrorPx = v; }},
      {"successProbability", {kNaN, kInfinite, -kInfinite, 0, 1, -0.5, 1.5}, [](auto& o, double v) { o.successProbability = v; }},
      {"maxIterations", {0, -1}, [](auto& o, double v) { o.maxIterations = static_cast<int>(v); }},
      {"minIterations", {-1}, [](auto& o, double v) { o.minIterations = static_cast<int>(v); }},
      {"timeBudgetSeconds", {kNaN, -kInfinite, 0, -1}, [](auto& o, double v) { o.timeBudgetSeconds = v; }},
      {"minFocalLength", {kNaN, kInfinite, -kInfinite, -1}, [](auto& o, double v) { o.minFocalLength = v; }},
      {"maxFocalLength", {kNaN, -kInfinite, 0, -1}, [](auto& o, double v) { o.maxFocalLength = v; }},
      {"maxFocalLength", {500, 1000}, [](auto& o, double v) { o.minFocalLength = 1000, o.maxFocalLength = v; }},
      {"knownFocalLengthPx", {kNaN, kInfinite, -kInfinite, 0, -1}, [](auto& o, double v) { o.knownFocalLengthPx = v; }},
      {"focalLengthPriorPx", {kNaN, kInfinite, 0, -1}, [](auto& o, double v) { o.focalLengthPriorPx = v; }},
      {"focalLengthPriorPx", {900}, [](auto& o, double v) { o.focalLengthPriorPx = o.knownFocalLengthPx = v; }},
      {"focalLengthPriorLogDeviation", {kNaN, kInfinite, 0, -1}, [](auto& o, double v) { o.focalLengthPriorLogDeviation = v; }},
      {"principalPointDeviationPx",
       {kNaN, kInfinite, -kInfinite, -1, -1e-9},
       [](auto& o, double v) { o.principalPointDeviationPx = v; }},
      {"imageRadiusPx", {kNaN, kInfinite, -kInfinite, -1}, [](auto& o, double v) { o.imageRadiusPx = v; }},
      {"distortionScale", {kNaN, kInfinite, 0, -1}, [](auto& o, double v) { o.distortionScale = v; }},
      {"distortionEvidence", {kNaN, kInfinite}, [](auto& o, double v) { o.distortionEvidence = v; }},
      {"distortionHypotheses",
       {kNaN, -0.7, 0.3, -1, kInfinite},
       [](auto& o, double v) {
         o.distortionHypotheses = {0, v};
       }},
      {"threads", {-1}, [](auto& o, double v) { o.threads = static_cast<int>(v); }},
      {"prior", {kNaN, kInfinite, -kInfinite, 0, -1}, [](auto& o, double v) { o.solvers[2].prior = v; }},
  };
  const NoncentralHybridAdapter adapter = goodAdapter();
  for (const auto& row : rows)
    for (const double value : row.wrong) {
      HybridRansacOptions options;
      row.set(options, value);
      const std::string wrong = row.option + (" = " + detail::format(value));
      expectRefused(wrong, row.option, [&] { options.check(); });
      expectRefused(wrong, ", is " + detail::format(value), [&] { options.check(); });
      expectRefused(wrong, row.option, [&] { sac::hybridRansac(adapter, options); });
    }
}

TEST(Misuse, RansacRefusesWrongListsOfSolversAndWrongStarts) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  HybridRansacOptions options;
  options.solvers = {};
  expectRefused("no solver", "solvers", [&] { sac::hybridRansac(adapter, options); });
  options.solvers = {{Solver::P4Pf, 1}, {Solver::H13f, 1}, {Solver::P4Pf, 2}};
  expectRefused("repeated solver", "solvers", [&] { sac::hybridRansac(adapter, options); });
  options.solvers = {{Solver::P4Pf, 1}, {Solver::H13f, 1}};
  options.knownFocalLengthPx = 1000;
  expectRefused("solvers that estimate what is known", "solvers", [&] { sac::hybridRansac(adapter, options); });
  options = {};
  options.solvers = {{Solver::H22, 1}, {Solver::H60, 1}};
  expectRefused("solvers that need the focal length", "solvers", [&] { sac::hybridRansac(adapter, options); });
  options = {};
  options.knownFocalLengthPx = 1000;
  options.minFocalLength = 1200;
  expectRefused("known but too small", "knownFocalLengthPx", [&] { sac::hybridRansac(adapter, options); });
  options = {};
  for (const Solver solver : noSolvers()) {
    const std::string value = std::to_string(static_cast<int>(solver));
    options.solvers = {{Solver::P4Pf, 1}, {solver, 1}};
    expectRefused("solver " + value, "options.solvers: no such value: " + value, [&] { options.check(); });
    expectRefused("solver " + value, "options.solvers: no such value: " + value, [&] { sac::hybridRansac(adapter, options); });
  }
  for (const WrongPose& wrong : wrongPoses()) {
    options = HybridRansacOptions();
    options.initialPose = wrong.pose;
    expectRefused(wrong.name, "initialPose", [&] { sac::hybridRansac(adapter, options); });
  }
}

TEST(Misuse, RansacRefusesValuesThatNoEnumerationHas) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  for (const int value : {-1, 2, 1000}) {
    HybridRansacOptions options;
    options.scoring = static_cast<sac::Scoring>(value);
    expectRefused("scoring " + std::to_string(value), "scoring", [&] { sac::hybridRansac(adapter, options); });
    options = HybridRansacOptions();
    options.sampling = static_cast<sac::Sampling>(value);
    expectRefused("sampling " + std::to_string(value), "sampling", [&] { sac::hybridRansac(adapter, options); });
  }
}

TEST(Misuse, RansacRefusesAStartOutsideTheFocalBounds) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  HybridRansacOptions options;
  options.minFocalLength = 500;
  options.maxFocalLength = 1000;
  options.initialPose = FocalPose();
  for (const double focalLength : {499.0, 1001.0}) {
    options.initialPose->focalLength = focalLength;
    const std::string wrong = "start with focal length " + std::to_string(focalLength);
    expectRefused(wrong, "initialPose", [&] { sac::hybridRansac(adapter, options); });
  }
  for (const double focalLength : {500.0, 1000.0}) {
    options.initialPose->focalLength = focalLength;
    EXPECT_NO_THROW(options.check());
  }
}

TEST(Misuse, RansacRefusesNumbersThatAreNotFinite) {
  std::vector<WrongField> fields = wrongRayFields();
  const std::vector<WrongField> ofPoints = wrongPointFields();
  fields.insert(fields.end(), ofPoints.begin(), ofPoints.end());
  for (const double value : {kNaN, kInfinite, -1.0})
    fields.push_back({"rig focal length " + std::to_string(value), [value](AlteredAdapter& a) { a.rigFocalLength = value; },
                      "getRigFocalLength(0)"});
  for (const double value : notFinite()) {
    fields.push_back(
        {"weight " + std::to_string(value), [value](AlteredAdapter& a) { a.weight2d2d = value; }, "getWeight2d2d(0)"});
    fields.push_back(
        {"weight " + std::to_string(value), [value](AlteredAdapter& a) { a.weight2d3d = value; }, "getWeight2d3d(0)"});
  }
  for (const WrongField& field : fields) {
    AlteredAdapter adapter;
    field.apply(adapter);
    expectRefused(field.name, field.getter, [&] { sac::hybridRansac(adapter); });
  }
}

TEST(Misuse, RansacWithoutCorrespondencesHasAReason) {
  const sac::HybridRansacResult result = sac::hybridRansac(NoncentralHybridAdapter({}, {}, {}, {}, {}, {}, {}));
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.failureReason, sac::FailureReason::TooFewCorrespondences);
}

TEST(Misuse, UnknownReasonsAreRefused) {
  for (const int value : {-1, 1000}) {
    expectRefused("failure", "reason", [&] { toString(static_cast<sac::FailureReason>(value)); });
    expectRefused("stop", "reason", [&] { toString(static_cast<sac::StopReason>(value)); });
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv
