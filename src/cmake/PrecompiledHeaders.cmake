# HYBRIDGV_PRECOMPILED_HEADERS: what nearly every file includes is compiled once for the library and once for all tests. For builds
# from nothing, as in the CI. Off by default, because a compiler cache does not store such objects unless it is told to
# (CCACHE_SLOPPINESS=pch_defines,time_macros), and because a file that forgets an include must not compile everywhere.
set(HYBRIDGV_COMMON_HEADERS <Eigen/Cholesky> <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <algorithm> <array> <cmath> <functional> <limits>
                            <memory> <optional> <sstream> <stdexcept> <string> <utility> <vector>)

function(hybridgv_precompile_headers target)
  if(HYBRIDGV_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${HYBRIDGV_COMMON_HEADERS} ${ARGN})
  endif()
endfunction()

# The headers of `target`, which is compiled with the same options.
function(hybridgv_reuse_precompiled_headers target from)
  if(HYBRIDGV_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()
