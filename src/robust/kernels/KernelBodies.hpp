// The kernels, for vectors of HYBRIDGV_LANES doubles. Included by one file per instruction set, each compiled for its own;
// everything has internal linkage so that no version can replace another.
#include <cmath>
#include <cstring>
#include <limits>

#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {
namespace {

using Real = double __attribute__((vector_size(HYBRIDGV_LANES * sizeof(double))));
using Mask = long long __attribute__((vector_size(HYBRIDGV_LANES * sizeof(double))));  // -1 or 0

constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline Real load(const double* from) {
  Real value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
inline Real all(double value) { return value - Real{}; }
inline bool isNone(Mask mask) {
  long long some = 0;
  for (int i = 0; i < HYBRIDGV_LANES; ++i) some |= mask[i];
  return some == 0;
}
inline Real where(Mask mask, Real value, Real otherwise) { return mask ? value : otherwise; }

template <class Function>
inline Real mapLanes(Real value, Function function) {
  for (int i = 0; i < HYBRIDGV_LANES; ++i) value[i] = function(value[i]);
  return value;
}
inline double sum(Real value) {
  double result = 0;
  for (int i = 0; i < HYBRIDGV_LANES; ++i) result += value[i];
  return result;
}
struct Vec {
  Real x, y, z;
};
inline Vec all(const double* v) { return {all(v[0]), all(v[1]), all(v[2])}; }
inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(Real s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Real dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

struct Pose {
  explicit Pose(const PlainPose& pose)
      : r1(all(pose.r1)),
        r2(all(pose.r2)),
        r3(all(pose.r3)),
        position(all(pose.position)),
        positionInQuery(toQuery(position)),
        f(all(pose.focalLength)) {}
  Vec toQuery(const Vec& v) const { return {dot(r1, v), dot(r2, v), dot(r3, v)}; }
  Vec r1, r2, r3;       // columns of the rotation R
  Vec position;         // p
  Vec positionInQuery;  // R^T p
  Real f;
};

inline Mask allLanes() { return Mask{} == Mask{}; }
inline Mask lanesBelow(std::size_t count) {
  Mask mask{};
  for (int lane = 0; lane < HYBRIDGV_LANES; ++lane) mask[lane] = static_cast<std::size_t>(lane) < count ? -1 : 0;
  return mask;
}

// Calls body(i, mask) for i = begin, begin + HYBRIDGV_LANES, .. below end; the mask tells which lanes are below it. The compiler
// makes two copies of the body, the first of which needs no mask.
template <class Body>
inline void forRange(std::size_t begin, std::size_t end, Body body) {
  std::size_t i = begin;
  for (; i + HYBRIDGV_LANES <= end; i += HYBRIDGV_LANES) body(i, allLanes());
  if (i < end) body(i, lanesBelow(end - i));
}

// The same for a body so long that it is not made part of the loop if there are two copies.
template <class Body>
inline void forRangeOfLongBody(std::size_t begin, std::size_t end, Body body) {
  for (std::size_t i = begin; i < end; i += HYBRIDGV_LANES) body(i, i + HYBRIDGV_LANES <= end ? allLanes() : lanesBelow(end - i));
}

// ---- 2D-3D: e = f (x/z, y/z) - (u, v), (x, y, z) = R^T X - R^T p ----

struct Reprojection {
  Reprojection(const PointArrays& points, std::size_t i, const Pose& pose) {
    const Vec point{load(points.x + i), load(points.y + i), load(points.z + i)};
    inQuery = pose.toQuery(point) - pose.positionInQuery;
    inFront = inQuery.z > 0;
    project(points, i, pose);
  }
  void project(const PointArrays& points, std::size_t i, const Pose& pose) {
    scale = pose.f / inQuery.z;
    projectedU = scale * inQuery.x, projectedV = scale * inQuery.y;
    errorU = projectedU - load(points.u + i), errorV = projectedV - load(points.v + i);
    squaredError = errorU * errorU + errorV * errorV;
  }

  Vec inQuery;
  Mask inFront;
  Real scale, projectedU, projectedV, errorU, errorV, squaredError;
};

// ---- 2D-2D: e = C / sqrt(G), see sampsonError ----

struct Epipolar {
  Epipolar(const RayArrays& rays, std::size_t i, const Pose& pose, Real unknownPixel) {
    direction = {load(rays.dx + i), load(rays.dy + i), load(rays.dz + i)};
    imageNormal = {load(rays.ax + i), load(rays.ay + i), load(rays.az + i)};
    const Vec centre{load(rays.cx + i), load(rays.cy + i), load(rays.cz + i)};
    image = {load(rays.u + i), load(rays.v + i), pose.f};
    w = image.x * pose.r1 + image.y * pose.r2 + image.z * pose.r3;
    t = centre - pose.position;
    l = cross(t, direction);
    n = cross(w, t);
    s = cross(w, direction);
    squaredPixelOfQuery = load(rays.isUnknown + i) * unknownPixel;
    squaredPixel = load(rays.squaredPixel + i) + squaredPixelOfQuery;
    l1 = dot(pose.r1, l), l2 = dot(pose.r2, l);
    alongNormal = dot(imageNormal, n);
    constraint = dot(w, l);
    varianceInMap = dot(n, n) - alongNormal * alongNormal;
    variance = l1 * l1 + l2 * l2 + squaredPixel * varianceInMap;
  }
  // The depths alpha = l.s / s.s and beta = -n.s / s.s are positive.
  Mask inFront() const { return (dot(l, s) > 0) & (dot(n, s) < 0); }
  Real squaredError() const { return constraint * constraint / variance; }

  Vec direction, imageNormal, image, w, t, l, n, s;
  Real squaredPixel, squaredPixelOfQuery, l1, l2, alongNormal, varianceInMap;
  Real constraint, variance;  // C, G
};

// 1/g^2 of a map image with unknown focal length.
inline double squaredPixelOfUnknown(const RayArrays& rays, const PlainPose& pose) {
  const double g = pose.focalLength < rays.leastFocalLength ? rays.leastFocalLength : pose.focalLength;
  return 1 / (g * g);
}

// ---- errors and scores ----

void squaredPointErrors(const PointArrays& points, const PlainPose& plainPose, double* errors) {
  const Pose pose(plainPose);
  for (std::size_t i = 0; i < points.size; i += HYBRIDGV_LANES) {
    const Reprojection point(points, i, pose);
    const Mask valid = point.inFront & (point.squaredError < kInfinity);
    const Real squared = where(valid, point.squaredError, all(kInfinity));
    std::memcpy(errors + i, &squared, sizeof squared);
  }
}

void squaredRayErrors(const RayArrays& rays, const PlainPose& plainPose, double* errors) {
  const Pose pose(plainPose);
  const Real unknownPixel = all(squaredPixelOfUnknown(rays, plainPose));
  for (std::size_t i = 0; i < rays.size; i += HYBRIDGV_LANES) {
    const Epipolar ray(rays, i, pose, unknownPixel);
    const Real error = ray.squaredError();
    const Real squared = where(ray.inFront() & (error < kInfinity), error, all(kInfinity));
    std::memcpy(errors + i, &squared, sizeof squared);
  }
}

// Sums up what is below the threshold; comparisons with NaN are false.
class ScoreSum {
 public:
  explicit ScoreSum(double squaredThreshold) : threshold_(all(squaredThreshold)), perSquare_(all(1 / squaredThreshold)) {}
  void add(Mask valid, Real squaredError) {
    const Mask inlier = valid & (squaredError < threshold_);
    gain_ += where(inlier, 1.0 - squaredError * perSquare_, Real{});
    inliers_ += where(inlier, all(1), Real{});
  }
  Score score() const { return {sum(gain_), static_cast<int>(sum(inliers_))}; }

 private:
  Real threshold_, perSquare_, gain_{}, inliers_{};
};

Score scorePoints(const PointArrays& points, const PlainPose& plainPose, double squaredThreshold, std::size_t begin,
                  std::size_t end) {
  const Pose pose(plainPose);
  ScoreSum result(squaredThreshold);
  forRange(begin, end, [&](std::size_t i, Mask inRange) {
    const Reprojection point(points, i, pose);
    result.add(point.inFront & inRange, point.squaredError);
  });
  return result.score();
}

Score scoreRays(const RayArrays& rays, const PlainPose& plainPose, double squaredThreshold, std::size_t begin, std::size_t end) {
  const Pose pose(plainPose);
  const Real unknownPixel = all(squaredPixelOfUnknown(rays, plainPose));
  ScoreSum result(squaredThreshold);
  forRange(begin, end, [&](std::size_t i, Mask inRange) {
    const Epipolar ray(rays, i, pose, unknownPixel);
    result.add(ray.inFront() & inRange, ray.squaredError());
  });
  return result.score();
}

// ---- normal equations ----

// A camera without distortion: the derivatives are by rotation, position and log f.
constexpr int kParameters = correspondences::kFocalPoseParameters;
constexpr int kTriangle = kParameters * (kParameters + 1) / 2;

using Row = Real[kParameters];

inline Real toTheEighth(Real q) {
  const Real q2 = q * q, q4 = q2 * q2;
  return q4 * q4;
}

inline Real log(Real values) {
  return mapLanes(values, [](double value) { return std::log(value); });
}

// The sum of logs as the log of a product, which is taken before it can overflow: every factor is from 1 to 1e9 + 1.
class LogSum {
 public:
  void add(Real factor) {
    product_ *= factor;
    if (++factors_ == 32) flush();
  }
  Real value() {
    flush();
    return sum_;
  }

 private:
  void flush() {
    sum_ += log(product_);
    product_ = all(1);
    factors_ = 0;
  }
  Real product_ = all(1), sum_{};
  int factors_ = 0;
};

// x = narrowing (error / scale)^2; that of no valid correspondence is infinite.
inline Real relativeSquare(const KindLoss& loss, Mask valid, Real squaredError, Real narrowing) {
  return where(valid, narrowing * squaredError * (1 / (loss.scale * loss.scale)), all(kInfinity));
}

// The derivative of rho(x) for one kind of loss; rho(infinity) has none.
inline Real slope(const KindLoss& loss, Real x) {
  switch (loss.loss) {
    case Loss::Quadratic:
      break;
    case Loss::Truncated:
      return where(x < 1.0, all(1), Real{});
    case Loss::Mixture:
      return 8 * loss.odds / ((1.0 + x) * (toTheEighth(1.0 + x) + loss.odds));
  }
  return all(1);
}

// The cost of one kind's correspondences, and their weights.
class CostSum {
 public:
  explicit CostSum(const KindLoss& loss) : loss_(loss) {}

  // Adds what the correspondences cost, and returns the weights of their squared errors. Those that are not valid have weight 0.
  // `narrowing` may be null.
  Real weigh(Mask inRange, Mask valid, Real squaredError, const double* narrowing = nullptr) {
    const Real factor = narrowing ? load(narrowing) : all(1);
    const Real x = relativeSquare(loss_, valid, squaredError, factor);
    if (loss_.loss == Loss::Mixture && !narrowing)
      logs_.add(where(inRange, mixtureFactor(x), all(1)));
    else
      rho_ += where(inRange, narrowing ? rho(x) / factor : rho(x), Real{});
    return where(inRange & valid, loss_.precision * slope(loss_, x), Real{});
  }
  double total() { return loss_.precision * loss_.scale * loss_.scale * sum(rho_ + logs_.value()); }

 private:
  Real rho(Real x) const {
    switch (loss_.loss) {
      case Loss::Quadratic:
        break;
      case Loss::Truncated:
        return where(x < 1.0, x, all(1));
      case Loss::Mixture:
        return log(mixtureFactor(x));
    }
    return x;
  }
  Real mixtureFactor(Real x) const { return (1.0 + loss_.odds) / (1.0 + loss_.odds / toTheEighth(1.0 + x)); }

  KindLoss loss_;
  LogSum logs_;
  Real rho_{};
};

// With y = R^T (X - p), m = (y_x, y_y) / y_z, s = f / y_z, and the position's derivatives in the query's frame at first, the
// derivatives of u and v by rotation, position and log f are
//
//     ( u m_v       -f - u m_u   v  |  -s   0   s m_u  |  u )
//     ( f + v m_v   -u m_v      -u  |   0  -s   s m_v  |  v ) ,
//
// because v m_u = u m_v. Many entries of J^T W J are 0, equal or opposite, which leaves 20 sums instead of 28.
class PointSums {
 public:
  void add(const Reprojection& point, Real inverseFocal, const Pose& pose, Real w) {
    const Real u = point.projectedU, v = point.projectedV, s = point.scale, errorU = point.errorU, errorV = point.errorV;
    const Real mu = u * inverseFocal, mv = v * inverseFocal, uv = u * mv, uu = -pose.f - u * mu, vv = pose.f + v * mv;
    const Real wu = w * u, wv = w * v, wuv = w * uv, wuu = w * uu, wvv = w * vv, ws = w * s;
    const Real radius = wu * u + wv * v, z = s * inverseFocal;  // 1 / y_z
    const Real turn0 = wuv * u + wvv * v, turn1 = wuu * u - wuv * v;
    turns_[0] += wuv * uv + wvv * vv, turns_[1] += wuv * (uu - vv), turns_[2] += wuu * uu + wuv * uv;
    roll_[0] += wuv * v - wvv * u, roll_[1] += wuu * v + wuv * u;
    shifts_[0] += ws * uv, shifts_[1] += ws * vv, shifts_[2] += ws * uu;
    depths_[0] += turn0 * z, depths_[1] += turn1 * z;
    zooms_[0] += turn0, zooms_[1] += turn1;
    positions_[0] += ws * s, positions_[1] += ws * s * mu, positions_[2] += ws * s * mv;
    images_[0] += ws * u, images_[1] += ws * v;
    radii_[0] += radius, radii_[1] += radius * z, radii_[2] += radius * z * z;
    gradient_[0] += wuv * errorU + wvv * errorV, gradient_[1] += wuu * errorU - wuv * errorV;
    gradient_[2] += wv * errorU - wu * errorV;
    gradient_[3] -= ws * errorU, gradient_[4] -= ws * errorV;
    const Real zoom = wu * errorU + wv * errorV;
    gradient_[5] += zoom * z, gradient_[6] += zoom;
  }

  void addTo(const PlainPose& pose, NormalEquations& total) const {
    double hessian[kParameters][kParameters] = {}, gradient[kParameters] = {};
    for (int i = 0; i < kParameters; ++i) gradient[i] = sum(gradient_[i]);
    const double uv = sum(shifts_[0]), u = sum(images_[0]), v = sum(images_[1]);
    hessian[0][0] = sum(turns_[0]), hessian[0][1] = sum(turns_[1]), hessian[1][1] = sum(turns_[2]);
    hessian[0][2] = sum(roll_[0]), hessian[1][2] = sum(roll_[1]);
    hessian[0][3] = -uv, hessian[0][4] = -sum(shifts_[1]), hessian[1][3] = -sum(shifts_[2]), hessian[1][4] = uv;
    hessian[2][3] = -v, hessian[2][4] = u, hessian[3][6] = -u, hessian[4][6] = -v;
    hessian[0][5] = sum(depths_[0]), hessian[1][5] = sum(depths_[1]);
    hessian[0][6] = sum(zooms_[0]), hessian[1][6] = sum(zooms_[1]);
    hessian[3][3] = hessian[4][4] = sum(positions_[0]);
    hessian[3][5] = -sum(positions_[1]), hessian[4][5] = -sum(positions_[2]);
    hessian[2][2] = hessian[6][6] = sum(radii_[0]), hessian[5][6] = sum(radii_[1]), hessian[5][5] = sum(radii_[2]);
    for (int row = 0; row < kParameters; ++row)
      for (int column = 0; column < row; ++column) hessian[row][column] = hessian[column][row];

    // The position in the rig's frame: its derivatives are R times those in the query's.
    turnPosition(pose, gradient);
    for (auto& row : hessian) turnPosition(pose, row);
    for (int column = 0; column < kParameters; ++column) {
      double entries[kParameters] = {};
      for (int row = 0; row < kParameters; ++row) entries[row] = hessian[row][column];
      turnPosition(pose, entries);
      for (int row = 0; row < kParameters; ++row) hessian[row][column] = entries[row];
    }
    for (int row = 0; row < kParameters; ++row) {
      total.gradient[row] += gradient[row];
      for (int column = row; column < kParameters; ++column) total.hessian[row][column] += hessian[row][column];
    }
  }

 private:
  static void turnPosition(const PlainPose& pose, double* entries) {
    const double x = entries[3], y = entries[4], z = entries[5];
    for (int k = 0; k < 3; ++k) entries[3 + k] = pose.r1[k] * x + pose.r2[k] * y + pose.r3[k] * z;
  }

  // Rotation by rotation about the image's axes and about the optical axis, by shifts in the image plane and in depth, by log f;
  // position by position in the image plane and by the rest; and what is a sum over u^2 + v^2.
  Real turns_[3] = {}, roll_[2] = {}, shifts_[3] = {}, depths_[2] = {}, zooms_[2] = {}, positions_[3] = {}, images_[2] = {},
       radii_[3] = {};
  Real gradient_[kParameters] = {};
};

void addPoints(const PointArrays& points, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (points.size == 0) return;
  const Pose pose(plainPose);
  const Real inverseFocal = all(1 / plainPose.focalLength);
  CostSum cost(loss);
  PointSums sums;
  forRangeOfLongBody(0, points.size, [&](std::size_t i, Mask inRange) {
    Reprojection point(points, i, pose);
    const Mask valid = point.inFront & (point.squaredError < kInfinity);
    const Real weight = cost.weigh(inRange, valid, point.squaredError);
    if (isNone(weight > 0)) return;
    if (!isNone(~valid)) {  // where there is no projection, any finite one will do
      Vec& y = point.inQuery;
      y = {where(valid, y.x, Real{}), where(valid, y.y, Real{}), where(valid, y.z, all(1))};
      point.project(points, i, pose);
    }
    sums.add(point, inverseFocal, pose, weight);
  });
  total.cost += cost.total();
  sums.addTo(plainPose, total);
}

// J^T W J and J^T W e of errors with any derivatives.
class NormalEquationsSum {
 public:
  void add(const Row& derivatives, Real error, Real weight) {
    for (int row = 0, k = 0; row < kParameters; ++row) {
      const Real weighted = weight * derivatives[row];
      gradient_[row] += weighted * error;
      for (int column = row; column < kParameters; ++column, ++k) hessian_[k] += weighted * derivatives[column];
    }
  }
  void addTo(NormalEquations& total) const {
    for (int row = 0, k = 0; row < kParameters; ++row) {
      total.gradient[row] += sum(gradient_[row]);
      for (int column = row; column < kParameters; ++column, ++k) total.hessian[row][column] += sum(hessian_[k]);
    }
  }

 private:
  Real gradient_[kParameters] = {}, hessian_[kTriangle] = {};
};

// The error e = C G^(-1/2) has the derivative G^(-1/2) (dC - C/G dG/2). Summed is G (de)^2 with the weight divided by G, which
// needs no square root. With q = (u, v, f), m the part of n in the map's image plane, all vectors in the rig's frame but for the
// rotation:
//   dC   = (q x R^T l) . rotation + s . dposition + f (r3.l) dlogf
//   dG/2 = (r3.l) (l2, -l1, 0) . rotation + R^T (w x (t x m)) h . rotation
//        + ((l1 r1 + l2 r2) x D + h w x m) . dposition + (h f r3 . (t x m) - hq m.n) dlogf
// where h is the squared pixel of the map image and hq the part of it that is 1/f^2.
[[gnu::always_inline]] inline void differentiate(const Epipolar& ray, Real variance, const Pose& pose, bool pixelVaries,
                                                 Row& derivatives) {
  const Real l3 = dot(pose.r3, ray.l), h = ray.squaredPixel;
  const Vec m = ray.n - ray.alongNormal * ray.imageNormal;
  const Vec tm = cross(ray.t, m);
  const Vec constraintByRotation = cross(ray.image, Vec{ray.l1, ray.l2, l3});
  const Vec mapByRotation = h * pose.toQuery(cross(ray.w, tm));
  const Vec varianceByPosition = cross(ray.l1 * pose.r1 + ray.l2 * pose.r2, ray.direction) + h * cross(ray.w, m);
  const Real pixelByFocal = pixelVaries ? ray.squaredPixelOfQuery * ray.varianceInMap : Real{};
  const Real varianceByFocal = h * pose.f * dot(pose.r3, tm) - pixelByFocal;
  const Real ratio = ray.constraint / variance;
  derivatives[0] = constraintByRotation.x - ratio * (l3 * ray.l2 + mapByRotation.x);
  derivatives[1] = constraintByRotation.y - ratio * (mapByRotation.y - l3 * ray.l1);
  derivatives[2] = constraintByRotation.z - ratio * mapByRotation.z;
  derivatives[3] = ray.s.x - ratio * varianceByPosition.x;
  derivatives[4] = ray.s.y - ratio * varianceByPosition.y;
  derivatives[5] = ray.s.z - ratio * varianceByPosition.z;
  derivatives[6] = pose.f * l3 - ratio * varianceByFocal;
}

inline bool pixelVaries(const RayArrays& rays, const PlainPose& pose) { return pose.focalLength >= rays.leastFocalLength; }

inline Mask isValid(const Epipolar& ray, Real squaredError, const KindLoss& loss) {
  const Mask isFinite = (ray.variance > 0) & (squaredError < kInfinity);
  return loss.loss == Loss::Quadratic ? isFinite : isFinite & ray.inFront();
}

void addRays(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (rays.size == 0) return;
  const Pose pose(plainPose);
  const Real unknownPixel = all(squaredPixelOfUnknown(rays, plainPose));
  CostSum cost(loss);
  NormalEquationsSum sums;
  forRangeOfLongBody(0, rays.size, [&](std::size_t i, Mask inRange) {
    const Epipolar ray(rays, i, pose, unknownPixel);
    const Real squaredError = ray.squaredError();
    const Mask valid = isValid(ray, squaredError, loss);
    const Real weight = cost.weigh(inRange, valid, squaredError, rays.narrowing ? rays.narrowing + i : nullptr);
    if (isNone(weight > 0)) return;
    const Real variance = where(valid, ray.variance, all(1));
    Row derivatives;
    differentiate(ray, variance, pose, pixelVaries(rays, plainPose), derivatives);
    sums.add(derivatives, ray.constraint, weight / variance);
  });
  total.cost += cost.total();
  sums.addTo(total);
}

void rayLeverages(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, const double* covariance,
                  double* leverages) {
  const Pose pose(plainPose);
  const Real unknownPixel = all(squaredPixelOfUnknown(rays, plainPose));
  for (std::size_t i = 0; i < rays.size; i += HYBRIDGV_LANES) {
    const Epipolar ray(rays, i, pose, unknownPixel);
    const Real squaredError = ray.squaredError();
    const Mask valid = isValid(ray, squaredError, loss);
    const Real narrowing = rays.narrowing ? load(rays.narrowing + i) : all(1);
    const Real weight = loss.precision * slope(loss, relativeSquare(loss, valid, squaredError, narrowing));
    const Real variance = where(valid, ray.variance, all(1));
    Row derivatives;
    differentiate(ray, variance, pose, pixelVaries(rays, plainPose), derivatives);
    Real quadraticForm{};
    for (int row = 0; row < kParameters; ++row)
      for (int column = 0; column < kParameters; ++column)
        quadraticForm += covariance[row * kMostParameters + column] * derivatives[row] * derivatives[column];
    const Real leverage = where(valid, weight / variance * quadraticForm, Real{});
    std::memcpy(leverages + i, &leverage, sizeof leverage);
  }
}

constexpr Kernels kTable = {squaredPointErrors, squaredRayErrors, scorePoints, scoreRays, addPoints, addRays, rayLeverages};

}  // namespace
}  // namespace robust
}  // namespace hybridgv
