/// \file
/// \brief Which instruction set the library's kernels use.
#pragma once

#include "hybridgv/export.hpp"

namespace hybridgv {

/// The instruction set of the kernels in this process: "baseline" (SSE2 on x86-64, NEON on AArch64), "avx2" or "avx512". It is the best one
/// that the processor has, or less if the environment variable HYBRIDGV_SIMD asks for less. Results of two machines are equal to the
/// last bit only if it is the same.
///
/// \throws std::invalid_argument if HYBRIDGV_SIMD is none of these names
HYBRIDGV_EXPORT const char* instructionSet();

}  // namespace hybridgv
