// Parts of the arrays. Not for the kernels' files: these functions are compiled for no particular instruction set.
#pragma once

#include <array>

#include "correspondences/ArrayViews.hpp"

namespace hybridgv {
namespace correspondences {

// All that have an entry for each correspondence, but for the narrowing.
inline std::array<const double**, 5> columnsOf(PointArrays& points) {
  return {&points.u, &points.v, &points.x, &points.y, &points.z};
}
inline std::array<const double**, 13> columnsOf(RayArrays& rays) {
  return {&rays.u,  &rays.v,  &rays.cx, &rays.cy, &rays.cz,           &rays.dx,       &rays.dy,
          &rays.dz, &rays.ax, &rays.ay, &rays.az, &rays.squaredPixel, &rays.isUnknown};
}

// Those from `begin` on, a multiple of kPadding, up to `end`, another or the size.
inline PointArrays part(PointArrays points, std::size_t begin, std::size_t end) {
  points.size = end - begin;
  for (const double** column : columnsOf(points)) *column += begin;
  return points;
}

inline RayArrays part(RayArrays rays, std::size_t begin, std::size_t end) {
  rays.size = end - begin;
  for (const double** column : columnsOf(rays)) *column += begin;
  rays.narrowing = rays.narrowing.from(begin);
  return rays;
}

}  // namespace correspondences
}  // namespace hybridgv
