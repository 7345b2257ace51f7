// A user's program, compiled for the generic instruction set and for this machine's (-march=native): both must get the same
// results from the one library.
//
//   abi_program record FILE     solves random problems and writes them with their results
//   abi_program compare FILE    reads them, solves them again and compares
//
// Between the calls it does dense linear algebra of its own, so that a mix-up of Eigen's code or memory in program and library
// shows. It reads the problems instead of making them again because the last bits of the arithmetic may differ.
#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"
#include "hybridgv/absolute_pose/methods.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"
#include "hybridgv/relative_pose/methods.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

using namespace hybridgv;

namespace {

constexpr std::uint64_t kProblems = 20;
constexpr double kTolerance = 1e-9;

using Numbers = std::vector<double>;

void append(Numbers& numbers, const FocalPose& pose) {
  numbers.insert(numbers.end(), pose.rotation.data(), pose.rotation.data() + 9);
  numbers.insert(numbers.end(), pose.position.data(), pose.position.data() + 3);
  numbers.push_back(pose.focalLength);
}

Numbers flatten(const FocalPoses& poses) {
  Numbers numbers;
  for (const FocalPose& pose : poses) append(numbers, pose);
  return numbers;
}

Numbers optimize(const hybrid_pose::HybridAdapterBase& adapter, const FocalPose& start) {
  const hybrid_pose::NonlinearResult result = hybrid_pose::optimize_nonlinear(adapter, start);
  Numbers numbers{result.cost};
  append(numbers, result.pose);
  numbers.insert(numbers.end(), result.information.begin(), result.information.end());
  return numbers;
}

Numbers residuals(const hybrid_pose::HybridAdapterBase& adapter, const FocalPose& pose) {
  Numbers numbers;
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i)
    numbers.push_back(hybrid_pose::reprojectionError(pose, adapter.getImagePoint2d3d(i), adapter.getPoint(i)));
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d2d(); ++i)
    numbers.push_back(hybrid_pose::sampsonError(pose, adapter.getImagePoint2d2d(i), adapter.getBearingVector(i),
                                                adapter.getCamOffset(i), adapter.getCamRotation(i), 0));
  return numbers;
}

Numbers robust(const hybrid_pose::HybridAdapterBase& adapter, const FocalPose& /*start*/) {
  sac::HybridRansacOptions options;
  options.seed = 1;
  options.maxIterations = 20;
  const sac::HybridRansacResult result = sac::hybridRansac(adapter, options);
  Numbers numbers{result.score, double(result.numberInliers2d2d), double(result.numberInliers2d3d), double(result.iterations)};
  append(numbers, result.pose);
  numbers.insert(numbers.end(), result.covariance.begin(), result.covariance.end());
  return numbers;
}

// What the problems for OpenGV's loops call.
Numbers opengvProblem(const hybrid_pose::HybridAdapterBase& adapter, const FocalPose& start) {
  const sac_problems::hybrid_pose::HybridProblemCore core(adapter, Solver::H13f, 12, 6);
  std::vector<int> all(adapter.getNumberCorrespondences2d2d() + adapter.getNumberCorrespondences2d3d());
  std::iota(all.begin(), all.end(), 0);
  Numbers numbers;
  core.distances(start, all, numbers);
  FocalPose model;
  if (core.computeModel({{0}, {0, 1, 2}}, core.makePool(all), model)) append(numbers, core.optimize(core.split(all), model));
  return numbers;
}

// What is called, on which problems; `start` is a pose near the truth.
struct Item {
  const char* name;
  std::vector<int> raysPerCamera;
  int points;
  std::function<Numbers(const hybrid_pose::HybridAdapterBase& adapter, const FocalPose& start)> run;
};

const std::vector<Item> kItems = {
    {"p4pf", {}, 4, [](const auto& adapter, const FocalPose&) { return flatten(absolute_pose::p4pf(adapter)); }},
    {"p35pf", {}, 4, [](const auto& adapter, const FocalPose&) { return flatten(absolute_pose::p35pf(adapter)); }},
    {"h13f", {1}, 3, [](const auto& adapter, const FocalPose&) { return flatten(hybrid_pose::h13f(adapter)); }},
    {"h32f", {2, 1}, 2, [](const auto& adapter, const FocalPose&) { return flatten(hybrid_pose::h32f(adapter)); }},
    {"h51f[1]", {1, 1, 1, 1, 1}, 1, [](const auto& adapter, const FocalPose&) { return flatten(hybrid_pose::h51f(adapter)); }},
    {"h51f[5]", {5}, 1, [](const auto& adapter, const FocalPose&) { return flatten(hybrid_pose::h51f(adapter)); }},
    {"h70f[6+1]", {6, 1}, 0, [](const auto& adapter, const FocalPose&) { return flatten(hybrid_pose::h70f(adapter)); }},
    {"h70f[4+3]", {4, 3}, 0, [](const auto& adapter, const FocalPose&) { return flatten(hybrid_pose::h70f(adapter)); }},
    {"sixpt_onefocal",
     {6},
     0,
     [](const auto& adapter, const FocalPose&) { return flatten(relative_pose::sixpt_onefocal(adapter)); }},
    {"optimize_nonlinear", {4, 4}, 10, optimize},
    {"residuals", {4, 4}, 10, residuals},
    {"hybridRansac", {10, 10}, 20, robust},
    {"HybridProblemCore", {4, 4}, 10, opengvProblem},
};

// All input of a problem as numbers, and back.
Numbers encode(const test::MinimalProblem& problem) {
  Numbers numbers;
  for (const auto& ray : problem.rays) {
    numbers.insert(numbers.end(), {ray.u, ray.v, double(ray.camera)});
    numbers.insert(numbers.end(), ray.centre.data(), ray.centre.data() + 3);
    numbers.insert(numbers.end(), ray.direction.data(), ray.direction.data() + 3);
  }
  for (const auto& match : problem.points) {
    numbers.insert(numbers.end(), {match.u, match.v});
    numbers.insert(numbers.end(), match.point.data(), match.point.data() + 3);
  }
  append(numbers, problem.truth);
  return numbers;
}

test::MinimalProblem decode(const Item& item, const Numbers& numbers) {
  test::MinimalProblem problem;
  const double* next = numbers.data();
  const auto vector = [&] {
    const Eigen::Vector3d value(next[0], next[1], next[2]);
    next += 3;
    return value;
  };
  for (int count : item.raysPerCamera)
    for (int i = 0; i < count; ++i) {
      solvers::RayMatch ray{next[0], next[1], {}, {}, int(next[2])};
      next += 3;
      ray.centre = vector();
      ray.direction = vector();
      problem.rays.push_back(ray);
    }
  for (int i = 0; i < item.points; ++i) {
    solvers::PointMatch match{next[0], next[1], {}};
    next += 2;
    match.point = vector();
    problem.points.push_back(match);
  }
  for (int i = 0; i < 3; ++i) problem.truth.rotation.col(i) = vector();
  problem.truth.position = vector();
  problem.truth.focalLength = *next;
  return problem;
}

FocalPose disturbed(FocalPose pose) {
  pose.position += Eigen::Vector3d(0.05, -0.03, 0.02);
  pose.focalLength *= 1.02;
  return pose;
}

// A user's own dense linear algebra: the least-squares solution of a random overdetermined system with a known solution.
bool ownAlgebraWorks(int seed) {
  std::srand(static_cast<unsigned>(seed));
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(40, 17);
  const Eigen::VectorXd x = Eigen::VectorXd::Random(17);
  const Eigen::VectorXd b = a * x;
  const Eigen::MatrixXd normal = a.transpose() * a;
  return (a.colPivHouseholderQr().solve(b) - x).norm() < 1e-9 && (normal.llt().solve(a.transpose() * b) - x).norm() < 1e-6;
}

void write(std::FILE* file, const Numbers& numbers) {
  std::fprintf(file, " %zu", numbers.size());
  for (double number : numbers) std::fprintf(file, " %.17g", number);
}

Numbers read(std::istream& in) {
  std::size_t count = 0;
  in >> count;
  Numbers numbers;
  std::string word;
  for (std::size_t i = 0; i < count && in >> word; ++i) numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

int record(const char* name) {
  std::FILE* file = std::fopen(name, "w");
  if (!file) return std::fprintf(stderr, "cannot write %s\n", name), 1;
  for (const Item& item : kItems)
    for (std::uint64_t i = 0; i < kProblems; ++i) {
      test::Random random(test::testSeed() + 40, i);
      const test::MinimalProblem problem = test::makeMinimalProblem(random, item.raysPerCamera, item.points);
      std::fprintf(file, "%s", item.name);
      write(file, encode(problem));
      write(file, item.run(test::makeAdapter(problem), disturbed(problem.truth)));
      std::fprintf(file, "\n");
    }
  return std::fclose(file);
}

bool nearlyEqual(double a, double b) { return a == b || std::abs(a - b) <= kTolerance * std::max(1.0, std::abs(b)); }

int compare(const char* name) {
  std::ifstream file(name);
  int lines = 0, failures = 0;
  std::vector<std::size_t> results(kItems.size());
  for (std::string line; std::getline(file, line); ++lines) {
    std::istringstream in(line);
    std::string key;
    in >> key;
    std::size_t index = 0;
    while (index < kItems.size() && key != kItems[index].name) ++index;
    if (index == kItems.size()) return std::fprintf(stderr, "%s: unknown item %s\n", name, key.c_str()), 1;
    const Item& item = kItems[index];
    const test::MinimalProblem problem = decode(item, read(in));
    const Numbers expected = read(in);
    const Numbers actual = item.run(test::makeAdapter(problem), disturbed(problem.truth));
    bool equal = expected.size() == actual.size();
    for (std::size_t i = 0; equal && i < actual.size(); ++i) equal = nearlyEqual(actual[i], expected[i]);
    if (!equal) ++failures, std::printf("line %d: %s differs\n", lines + 1, item.name);
    if (!ownAlgebraWorks(lines)) ++failures, std::printf("line %d: the program's own linear algebra fails\n", lines + 1);
    results[index] += actual.size();
  }
  for (std::size_t i = 0; i < kItems.size(); ++i) {
    std::printf("%-20s %zu numbers compared\n", kItems[i].name, results[i]);
    failures += results[i] == 0;
  }
  std::printf("Eigen aligns to %d bytes in this program; %d lines, %d failures\n", EIGEN_MAX_ALIGN_BYTES, lines, failures);
  return failures > 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc == 3 ? argv[1] : "";
  if (mode == "record") return record(argv[2]);
  if (mode == "compare") return compare(argv[2]);
  std::fprintf(stderr, "usage: %s record|compare FILE\n", argv[0]);
  return 2;
}
