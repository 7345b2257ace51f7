#include "start_systems/KnownFocalFamily.hpp"

namespace hybridgv {
namespace test {

using solvers::complex_rays::ComplexNumber;
using solvers::complex_rays::Frame;

constexpr double kSceneSize = 10;  // about 1 in the frame

Frame KnownFocalFamily::frameOf(const Sharing& sharing, const MinimalProblem& problem) {
  Frame frame;
  if (sharing.sharedRays() > 0) frame.origin = problem.rays[0].centre;
  frame.length = kSceneSize;
  frame.imageScale = problem.truth.focalLength;
  return frame;
}

// A point's rays have the directions of two axes, whatever the system: then their moments are linear in the point, which stays one
// on a straight way between two systems.
KnownFocalFamily::Parameters KnownFocalFamily::parametersIn(const Frame& frame, const MinimalProblem& problem) {
  Parameters parameters{};
  int row = 0;
  const auto add = [&](const solvers::RayMatch& ray) {
    const Eigen::Vector3d centre = (ray.centre - frame.origin) / frame.length;
    setRay(frame, ray, centre, row++, &parameters);
  };
  for (const solvers::PointMatch& match : problem.points)
    for (const int axis : {0, 1}) add({match.u, match.v, match.point, Eigen::Vector3d::Unit(axis), -1});
  for (const solvers::RayMatch& ray : problem.rays) add(ray);
  return parameters;
}

KnownSystem<KnownFocalFamily> KnownFocalFamily::randomRealSystem(const Sharing& sharing, Random& random) {
  const MinimalProblem problem = makeMinimalProblem(random, sharing.raysPerCamera, sharing.points);
  const Frame frame = frameOf(sharing, problem);
  const solvers::h70f::Solution truth = solvers::h70f::solutionOf(problem.truth, frame);
  return {
      sharing,
      parametersIn(frame, problem),
      {pointOf<PathProblem::System::kUnknowns>({truth.x, truth.y, truth.tauBar, truth.tau, truth.t3, truth.alpha, truth.beta})}};
}

static void setVector(const ComplexNumber& x, const ComplexNumber& y, const ComplexNumber& z, ComplexNumber (&vector)[3]) {
  vector[0] = x;
  vector[1] = y;
  vector[2] = z;
}

void KnownFocalFamily::restoreSharedCentres(const Sharing& sharing, Parameters* parameters) {
  for (int i = 0; i < sharing.points; ++i) {
    const int first = 2 * i, second = first + 1;
    auto &m = parameters->moment[first], &n = parameters->moment[second];
    setVector({1, 0}, {0, 0}, {0, 0}, parameters->direction[first]);
    setVector({0, 0}, {1, 0}, {0, 0}, parameters->direction[second]);
    m[0] = n[1] = {0, 0};  // m is (0, -Z, Y) and n is (Z, 0, -X)
    n[0] = {-m[1].re, -m[1].im};
    parameters->image[second] = parameters->image[first];
    parameters->imageBar[second] = parameters->imageBar[first];
  }
  const int firstShared = 2 * sharing.points;
  for (int j = 0; j < sharing.sharedRays(); ++j) restoreMoment(firstShared + j, 0, parameters);
}

}  // namespace test
}  // namespace hybridgv
