#include "hybridgv/distortion.hpp"

#include <algorithm>
#include <cmath>

#include "CheckArguments.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {

Eigen::Vector3d undistort(double distortion, const Eigen::Vector3d& imagePoint) {
  const double u = imagePoint[0] / imagePoint[2], v = imagePoint[1] / imagePoint[2];
  const double depth = 1 + distortion * (u * u + v * v);
  if (!std::isfinite(u) || !std::isfinite(v) || !std::isfinite(depth)) return Eigen::Vector3d::Zero();
  if (!(depth > 0)) return {u, v, 0};
  return {u / depth, v / depth, 1};
}

std::optional<Eigen::Vector3d> distort(double distortion, const Eigen::Vector3d& imagePoint) {
  const double u = imagePoint[0] / imagePoint[2], v = imagePoint[1] / imagePoint[2];
  const double radicand = 1 - 4 * distortion * (u * u + v * v);
  if (!(radicand > 0) || !std::isfinite(radicand) || !std::isfinite(u) || !std::isfinite(v)) return std::nullopt;
  const double stretch = 2 / (1 + std::sqrt(radicand));
  return Eigen::Vector3d(stretch * u, stretch * v, 1);
}

SimpleRadial toSimpleRadial(double focalLength, double distortion, const std::vector<double>& radii) {
  checkPositive("focalLength", focalLength);
  if (!std::isfinite(distortion)) throwInvalid("distortion", "must be finite, is " + detail::format(distortion));
  const SimpleRadial pinhole{focalLength, 0};
  const auto isNumber = [](double radius) { return std::isfinite(radius); };
  if (distortion == 0 || radii.empty() || !std::all_of(radii.begin(), radii.end(), isNumber)) return pinhole;
  // In units of the largest radius: then the sums are of one size.
  const double unit = *std::max_element(radii.begin(), radii.end());
  if (!(unit > 0 && 1 + distortion * unit * unit > 0)) return pinhole;
  double xx = 0, xy = 0, yy = 0, xr = 0, yr = 0;
  for (const double radius : radii) {
    const double r = radius / unit, x = r / (1 + distortion * radius * radius), y = x * x * x;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xr += x * r;
    yr += y * r;
  }
  constexpr double kSmall = 1e-12;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > kSmall * xx * yy)) return pinhole;
  // r = a x + b x^3 with x in units of unit / focalLength.
  const double a = (xr * yy - yr * xy) / determinant, b = (yr * xx - xr * xy) / determinant;
  const double perUnit = focalLength / unit;
  return {a * focalLength, b / a * perUnit * perUnit};
}

}  // namespace hybridgv
