#include "h51f_sphere/solve.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "h51f_sphere/Equations.hpp"
#include "h51f_sphere/Icosphere.hpp"

namespace hybridgv {
namespace test {
namespace h51f_sphere {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using solvers::PointMatch;
using solvers::RayMatch;

// --- data

struct Scales {
  double length, image;
};

// The rays of the centre that most rays have come first. Returns how many those are.
int arrange(std::vector<RayMatch>* rays) {
  const auto members = [&](const RayMatch& a) {
    return std::count_if(rays->begin(), rays->end(), [&](const RayMatch& b) { return a.centre == b.centre; });
  };
  const RayMatch largest =
      *std::max_element(rays->begin(), rays->end(), [&](const auto& a, const auto& b) { return members(a) < members(b); });
  std::stable_partition(rays->begin(), rays->end(), [&](const RayMatch& ray) { return ray.centre == largest.centre; });
  return static_cast<int>(members((*rays)[0]));
}

Data<double> makeData(const std::vector<RayMatch>& rays, const PointMatch& point, bool fourShared, Scales* scales) {
  Data<double> data;
  *scales = {0, std::max(std::abs(point.u), std::abs(point.v))};
  for (const RayMatch& ray : rays) {
    scales->length += (ray.centre - point.point).norm() / kRays;
    scales->image = std::max({scales->image, std::abs(ray.u), std::abs(ray.v)});
  }
  scales->image *= 2;
  for (int j = 0; j < kRays; ++j) {
    const RayMatch& ray = rays[static_cast<std::size_t>(j)];
    Eigen::Map<Vector3d>(data.direction[j]) = ray.direction;
    Eigen::Map<Vector3d>(data.moment[j]) = ray.direction.cross(ray.centre - point.point) / scales->length;
    data.image[j][0] = ray.u / scales->image;
    data.image[j][1] = ray.v / scales->image;
  }
  data.point[0] = point.u / scales->image;
  data.point[1] = point.v / scales->image;
  data.pointRadius = std::hypot(data.point[0], data.point[1]);
  const bool central = data.pointRadius == 0;
  data.pointAxis[0] = central ? 1 : data.point[0] / data.pointRadius;
  data.pointAxis[1] = central ? 0 : data.point[1] / data.pointRadius;
  Eigen::Map<Vector3d>(data.sharedCentre) = (rays[0].centre - point.point) / scales->length;
  data.fourShared = fourShared;
  return data;
}

Data<float> narrow(const Data<double>& from) {
  Data<float> to;
  const auto convert = [](double a) { return static_cast<float>(a); };
  std::transform(&from.direction[0][0], &from.direction[0][0] + 3 * kRays, &to.direction[0][0], convert);
  std::transform(&from.moment[0][0], &from.moment[0][0] + 3 * kRays, &to.moment[0][0], convert);
  std::transform(&from.image[0][0], &from.image[0][0] + 2 * kRays, &to.image[0][0], convert);
  std::transform(from.point, from.point + 2, to.point, convert);
  std::transform(from.pointAxis, from.pointAxis + 2, to.pointAxis, convert);
  std::transform(from.sharedCentre, from.sharedCentre + 3, to.sharedCentre, convert);
  to.pointRadius = convert(from.pointRadius);
  to.fourShared = from.fourShared;
  return to;
}

// --- isolation

struct Corner {
  Vector3f n;
  float G1, G2;
  bool forward;  // d > 0
};
using Triangle = std::array<Corner, 3>;

// Values at every direction, as many at a time as there are lanes.
std::vector<Corner> sampleAll(const Data<float>& data, const std::vector<Vector3f>& directions) {
  constexpr std::size_t W = LaneTraits<Floats>::kWidth;
  std::vector<Corner> corners(directions.size());
  for (std::size_t first = 0; first < directions.size(); first += W) {
    const std::size_t count = std::min(W, directions.size() - first);
    Floats n[3];
    for (std::size_t lane = 0; lane < W; ++lane)
      for (int k = 0; k < 3; ++k) n[k][lane] = directions[first + std::min(lane, count - 1)][k];
    const Sample<Floats> s = sampleAt(data, frameAt(n));
    const Floats forward = larger(s.v[0] * s.v[5], s.v[1] * s.v[3] + s.v[2] * s.v[4]);
    for (std::size_t lane = 0; lane < count; ++lane)
      corners[first + lane] = {directions[first + lane], s.G1[lane], s.G2[lane], forward[lane] > 0};
  }
  return corners;
}

// The common zero of the functions' linear interpolants in barycentric coordinates u / D.
struct LinearRoot {
  float u[3], D;
  float area;  // D of two perpendicular functions of the same ranges
};

LinearRoot linearRoot(const Triangle& t) {
  LinearRoot root;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = t[(i + 1) % 3], &b = t[(i + 2) % 3];
    root.u[i] = a.G1 * b.G2 - b.G1 * a.G2;
  }
  root.D = root.u[0] + root.u[1] + root.u[2];
  const auto range = [&t](float Corner::*G) { return std::minmax({t[0].*G, t[1].*G, t[2].*G}); };
  const auto range1 = range(&Corner::G1), range2 = range(&Corner::G2);
  root.area = (range1.second - range1.first) * (range2.second - range2.first);
  return root;
}

bool isNearlyParallel(const LinearRoot& root) { return std::abs(root.D) < 0.05f * root.area; }

bool mayHaveZero(const Triangle& t, float margin, float parallelMargin) {
  if (!t[0].forward && !t[1].forward && !t[2].forward) return false;
  const auto staysAway = [&](float Corner::*G) {
    const float least = std::min({t[0].*G, t[1].*G, t[2].*G}), most = std::max({t[0].*G, t[1].*G, t[2].*G});
    return least > margin * (most - least) || most < -margin * (most - least);
  };
  if (staysAway(&Corner::G1) || staysAway(&Corner::G2)) return false;
  const LinearRoot root = linearRoot(t);
  if (isNearlyParallel(root)) return true;
  const float sign = root.D < 0 ? -1.0f : 1.0f;
  const float least = std::min({sign * root.u[0], sign * root.u[1], sign * root.u[2]});  // smallest u / D, times |D|
  return least >= -margin * (std::abs(root.D) + parallelMargin * root.area);
}

std::vector<Triangle> divided(const Data<float>& data, const std::vector<Triangle>& triangles) {
  std::vector<Vector3f> midpoints;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) midpoints.push_back((t[i].n + t[(i + 1) % 3].n).normalized());
  const std::vector<Corner> m = sampleAll(data, midpoints);
  std::vector<Triangle> parts;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const Corner &m01 = m[3 * i], &m12 = m[3 * i + 1], &m20 = m[3 * i + 2];
    parts.insert(parts.end(), {{t[0], m01, m20}, {m01, t[1], m12}, {m20, m12, t[2]}, {m01, m12, m20}});
  }
  return parts;
}

// The zero of the interpolants, moved into the triangle; its centre if there is none.
Vector3d startingDirection(const Triangle& t) {
  const LinearRoot root = linearRoot(t);
  Vector3f n = Vector3f::Zero();
  for (std::size_t i = 0; i < 3; ++i) n += (isNearlyParallel(root) ? 1.0f : std::max(0.0f, root.u[i] / root.D)) * t[i].n;
  return n.cast<double>().normalized();
}

// --- Newton's method

struct State {
  Matrix3d R;  // X_query = R X + t
  double kappa, rho;
};

State stateAt(const Data<double>& data, const Vector3d& direction) {
  const double n[3] = {direction[0], direction[1], direction[2]};
  const h51f_sphere::Frame<double> frame = frameAt(n);
  const Sample<double> sample = sampleAt(data, frame);
  double v[6];
  for (int k = 0; k < 6; ++k) v[k] = sample.v[0] < 0 ? -sample.v[k] : sample.v[k];
  const double size = std::hypot(v[1], v[2]), cosine = v[1] / size, sine = v[2] / size;
  const Vector3d t1(frame.t1), t2(frame.t2);
  State state;
  state.R << (cosine * t1 - sine * t2).transpose(), (sine * t1 + cosine * t2).transpose(), direction.transpose();
  state.kappa = size / v[0];
  state.rho = state.kappa * (v[1] * v[3] + v[2] * v[4]) / (size * size);
  return state;
}

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

void evaluate(const Data<double>& data, const State& x, Vector5d* g, Matrix5d* J) {
  for (int j = 0; j < kRays; ++j) {
    const double px = data.image[j][0], py = data.image[j][1], Dx = data.point[0] - px, Dy = data.point[1] - py;
    const double s = px * data.point[1] - py * data.point[0];
    const Vector3d a = x.R * Vector3d(data.moment[j]), b = x.R * Vector3d(data.direction[j]);
    const Vector3d A(-x.kappa * px, -x.kappa * py, -1), B(-x.rho * Dy, x.rho * Dx, x.rho * x.kappa * s);
    (*g)[j] = A.dot(a) + B.dot(b);
    J->row(j) << (a.cross(A) + b.cross(B)).transpose(), -(px * a[0] + py * a[1]) + x.rho * s * b[2],
        Dx * b[1] - Dy * b[0] + x.kappa * s * b[2];
  }
}

// False if the steps do not become small soon.
bool converge(const Data<double>& data, State* x) {
  Vector5d g;
  Matrix5d J;
  bool small = false;
  for (int i = 0; i < 12; ++i) {
    evaluate(data, *x, &g, &J);
    const Vector5d step = -J.partialPivLu().solve(g);
    const double turn = step.head<3>().norm();
    const double relative = std::max({turn, std::abs(step[3] / x->kappa), std::abs(step[4] / x->rho)});
    if (!(relative < (i < 2 ? 1e300 : i < 4 ? 2 : 0.5))) return false;
    const double damping = std::min(1.0, 0.5 / relative);
    if (turn > 0) x->R = Eigen::AngleAxisd(damping * turn, step.head<3>() / turn) * x->R;
    x->kappa += damping * step[3];
    x->rho += damping * step[4];
    if (small) break;
    small = relative < 1e-7;
  }
  evaluate(data, *x, &g, &J);
  return small && g.norm() < 1e-10;
}

// Is the query at the centre that several rays share?
bool isImproper(const Data<double>& data, const State& x) {
  const Vector3d t = x.rho * Vector3d(data.point[0], data.point[1], 1 / x.kappa);
  return (x.R * Vector3d(data.sharedCentre) + t).norm() < 1e-7;
}

const Icosphere& icosphere(int frequency) {
  static std::map<int, Icosphere> spheres;
  const auto found = spheres.find(frequency);
  return found != spheres.end() ? found->second : spheres.emplace(frequency, makeIcosphere(frequency)).first->second;
}

std::vector<Triangle> isolate(const Data<float>& data, const Icosphere& sphere, const Resolution& resolution) {
  const std::vector<Corner> corners = sampleAll(data, sphere.directions);
  std::vector<Triangle> triangles;
  const auto keep = [&](const Triangle& t, double margin) {
    if (mayHaveZero(t, static_cast<float>(margin), static_cast<float>(resolution.parallelMargin))) triangles.push_back(t);
  };
  const auto corner = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
  for (const std::array<int, 3>& t : sphere.triangles) keep({corner(t[0]), corner(t[1]), corner(t[2])}, resolution.margin);
  for (int level = 0; level < resolution.levels; ++level) {
    const std::vector<Triangle> parts = divided(data, triangles);
    triangles.clear();
    for (const Triangle& t : parts) keep(t, resolution.levelMargin[level]);
  }
  return triangles;
}

}  // namespace

FocalPoses solve(const std::vector<RayMatch>& rays, const PointMatch& point, const Resolution& resolution) {
  std::vector<RayMatch> arranged = rays;
  const int shared = arrange(&arranged);
  Scales scales;
  const Data<double> data = makeData(arranged, point, shared == 4, &scales);
  const Icosphere& sphere = icosphere(resolution.frequency);
  const double cell = static_cast<double>(sphere.edge) / (1 << resolution.levels);
  std::vector<State> found;
  for (const Triangle& triangle : isolate(narrow(data), sphere, resolution)) {
    const Vector3d n = startingDirection(triangle);
    const auto isNear = [&](const State& x) { return (x.R.row(2).transpose() - n).norm() < 0.3 * cell; };
    if (std::any_of(found.begin(), found.end(), isNear)) continue;
    State x = stateAt(data, n);
    if (!converge(data, &x)) continue;
    if (x.kappa < 0) x = {Vector3d(-1, -1, 1).asDiagonal() * x.R, -x.kappa, -x.rho};
    if (!(x.rho > 0) || (shared > 2 && isImproper(data, x))) continue;
    const auto isSame = [&](const State& y) { return (x.R - y.R).norm() + std::abs(x.kappa / y.kappa - 1) < 1e-7; };
    if (std::none_of(found.begin(), found.end(), isSame)) found.push_back(x);
  }
  FocalPoses poses;
  for (const State& x : found) {
    FocalPose pose;
    pose.rotation = x.R.transpose();
    pose.focalLength = scales.image / x.kappa;
    const double depth = x.rho / x.kappa * scales.length;
    pose.position = point.point - depth * pose.rotation * Vector3d(x.kappa * data.point[0], x.kappa * data.point[1], 1);
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace h51f_sphere
}  // namespace test
}  // namespace hybridgv
