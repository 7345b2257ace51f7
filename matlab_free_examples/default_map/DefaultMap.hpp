// The synthetic sparse model that the examples use when they are given no other.
#pragma once

#include <cstdint>

#include "hybridgv/adapters/sfm/SparseModel.hpp"

// Images of a building, taken around two of its corners with cameras of different focal lengths and distortions, and the points
// that they see on its facades (with recessed windows, balconies and a roof) and on the ground. Image positions carry Gaussian
// noise; the points are triangulated from them, as a structure-from-motion program would have left them; poses and cameras are
// exact. Tracks have the lengths that feature matching gives: many points are seen twice only.
//
// The same seed gives the same model (numbers are rounded as they are to be written).
hybridgv::sfm::SparseModel makeDefaultMap(std::uint64_t seed);
