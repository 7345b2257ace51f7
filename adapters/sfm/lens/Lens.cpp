#include "Lens.hpp"

#include <cmath>

#include "ClosedForms.hpp"

namespace hybridgv {
namespace sfm {
namespace {

const double kPi = std::acos(-1.0);
constexpr double kNoAngle = 1e-150;  // below, FOV is a pinhole to rounding, and its formula loses digits

template <class Value>
std::optional<Value> ifFinite(const std::optional<Value>& value) {
  return value && value->allFinite() ? value : std::nullopt;
}

}  // namespace

Lens::Lens(const Camera& camera) {
  const std::vector<double>& p = camera.parameters;
  // The parameters start with f cx cy, or with fx fy cx cy.
  const auto setShared = [&] { fx_ = p[0], fy_ = p[0], cx_ = p[1], cy_ = p[2]; };
  const auto setSeparate = [&] { fx_ = p[0], fy_ = p[1], cx_ = p[2], cy_ = p[3]; };
  const auto setRadial = [&](std::initializer_list<double> k) { first_.radial = {k, {}, RadialProfile::kInfinity}; };
  const auto setAngular = [&](std::initializer_list<double> k) {
    kind_ = Kind::Angle;
    first_.radial = {k, {}, kPi};
  };
  switch (camera.model) {
    case CameraModel::SimplePinhole:
      setShared();
      break;
    case CameraModel::Pinhole:
      setSeparate();
      break;
    case CameraModel::SimpleRadial:
      setShared();
      setRadial({p[3]});
      break;
    case CameraModel::Radial:
      setShared();
      setRadial({p[3], p[4]});
      break;
    case CameraModel::OpenCV:
      setSeparate();
      setRadial({p[4], p[5]});
      first_.p1 = p[6];
      first_.p2 = p[7];
      break;
    case CameraModel::OpenCVFisheye:
      setSeparate();
      setAngular({p[4], p[5], p[6], p[7]});
      break;
    case CameraModel::FullOpenCV:
      setSeparate();
      first_.radial = {{p[4], p[5], p[8]}, {p[9], p[10], p[11]}, RadialProfile::kInfinity};
      first_.p1 = p[6];
      first_.p2 = p[7];
      break;
    case CameraModel::Fov:
      setSeparate();
      kind_ = Kind::Fov;
      a_ = std::abs(p[4]) < kNoAngle ? 0 : p[4];
      break;
    case CameraModel::SimpleRadialFisheye:
      setShared();
      setAngular({p[3]});
      break;
    case CameraModel::RadialFisheye:
      setShared();
      setAngular({p[3], p[4]});
      break;
    case CameraModel::ThinPrismFisheye:
      setSeparate();
      setAngular({p[4], p[5], p[8], p[9]});
      first_.p1 = p[6];
      first_.p2 = p[7];
      first_.sx1 = p[10];
      first_.sy1 = p[11];
      break;
    case CameraModel::RadTanThinPrismFisheye:
      setSeparate();
      setAngular({p[4], p[5], p[6], p[7], p[8], p[9]});
      second_.p2 = p[10];
      second_.p1 = p[11];
      second_.sx1 = p[12];
      second_.sx2 = p[13];
      second_.sy1 = p[14];
      second_.sy2 = p[15];
      break;
    case CameraModel::SimpleDivision:
      setShared();
      kind_ = Kind::Division;
      a_ = p[3];
      break;
    case CameraModel::Division:
      setSeparate();
      kind_ = Kind::Division;
      a_ = p[4];
      break;
    case CameraModel::SimpleFisheye:
      setShared();
      setAngular({});
      break;
    case CameraModel::Fisheye:
      setSeparate();
      setAngular({});
      break;
    case CameraModel::Eucm:
      setSeparate();
      kind_ = Kind::Eucm;
      a_ = p[4];
      b_ = p[5];
      break;
    case CameraModel::Equirectangular:
      kind_ = Kind::Sphere;
      fx_ = p[0] / (2 * kPi);
      fy_ = p[1] / kPi;
      cx_ = p[0] / 2;
      cy_ = p[1] / 2;
      break;
    case CameraModel::NvmRadial:
      setSeparate();
      kind_ = Kind::PlaneInverse;
      setRadial({p[4]});
      break;
    case CameraModel::Unknown:
      break;
  }
}

std::optional<Eigen::Vector2d> Lens::distorted(const Eigen::Vector2d& point) const {
  const std::optional<Eigen::Vector2d> between = first_.apply(point);
  return between ? second_.apply(*between) : std::nullopt;
}

std::optional<Eigen::Vector2d> Lens::undistorted(const Eigen::Vector2d& image) const {
  const std::optional<Eigen::Vector2d> between = second_.invert(image);
  return between ? first_.invert(*between) : std::nullopt;
}

std::optional<Eigen::Vector3d> Lens::direction(const Eigen::Vector2d& image) const {
  switch (kind_) {
    case Kind::Plane:
    case Kind::PlaneInverse: {
      const std::optional<Eigen::Vector2d> point = kind_ == Kind::Plane ? undistorted(image) : distorted(image);
      if (!point) return std::nullopt;
      return Eigen::Vector3d(point->x(), point->y(), 1);
    }
    case Kind::Angle: {
      const std::optional<Eigen::Vector2d> point = undistorted(image);
      return point ? equidistantRay(*point) : std::nullopt;
    }
    case Kind::Fov:
      return fovRay(image, a_);
    case Kind::Division:
      return divisionRay(image, a_);
    case Kind::Eucm:
      return eucmRay(image, a_, b_);
    case Kind::Sphere:
      return sphereRay(image);
  }
  return std::nullopt;
}

std::optional<Eigen::Vector2d> Lens::image(const Eigen::Vector3d& point) const {
  switch (kind_) {
    case Kind::Plane:
    case Kind::PlaneInverse: {
      if (!(point[2] > 0)) return std::nullopt;
      const Eigen::Vector2d onPlane = point.head<2>() / point[2];
      return kind_ == Kind::Plane ? distorted(onPlane) : undistorted(onPlane);
    }
    case Kind::Angle: {
      const std::optional<Eigen::Vector2d> angles = equidistantImage(point);
      return angles ? distorted(*angles) : std::nullopt;
    }
    case Kind::Fov:
      return fovImage(point, a_);
    case Kind::Division:
      return divisionImage(point.stableNormalized(), a_);
    case Kind::Eucm:
      return eucmImage(point.stableNormalized(), a_, b_);
    case Kind::Sphere:
      return sphereImage(point);
  }
  return std::nullopt;
}

std::optional<Eigen::Vector3d> Lens::ray(double x, double y) const {
  const std::optional<Eigen::Vector3d> result = direction(Eigen::Vector2d((x - cx_) / fx_, (y - cy_) / fy_));
  if (!result) return std::nullopt;
  const Eigen::Vector3d unit = result->stableNormalized();
  return unit.squaredNorm() > 0.5 ? ifFinite<Eigen::Vector3d>(unit) : std::nullopt;
}

std::optional<Eigen::Vector2d> Lens::project(const Eigen::Vector3d& point) const {
  const std::optional<Eigen::Vector2d> result = image(point);
  if (!result) return std::nullopt;
  return ifFinite<Eigen::Vector2d>(Eigen::Vector2d(fx_ * result->x() + cx_, fy_ * result->y() + cy_));
}

std::optional<Eigen::Vector2d> Lens::plane(double x, double y) const {
  const std::optional<Eigen::Vector3d> result = direction(Eigen::Vector2d((x - cx_) / fx_, (y - cy_) / fy_));
  if (!result || !(result->z() > 0)) return std::nullopt;
  return ifFinite<Eigen::Vector2d>(Eigen::Vector2d(result->head<2>() / result->z()));
}

std::optional<Eigen::Vector2d> Lens::projectPlane(const Eigen::Vector2d& point) const {
  return project(Eigen::Vector3d(point.x(), point.y(), 1));
}

}  // namespace sfm
}  // namespace hybridgv
