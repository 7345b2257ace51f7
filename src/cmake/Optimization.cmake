# hybridgv_optimize(target): in a project that chooses no build type the compiler would not optimize, and the solvers would take
# many times as long. A build type that the project does choose is its own affair; that Debug is slow is said once.
function(hybridgv_optimize target)
  if(CMAKE_CONFIGURATION_TYPES OR NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    return()
  endif()
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS MATCHES "-O")
    target_compile_options(${target} PRIVATE -O3)
    message(STATUS "hybridgv: no CMAKE_BUILD_TYPE; the library itself is compiled with -O3")
  elseif(CMAKE_BUILD_TYPE STREQUAL "Debug" AND NOT HYBRIDGV_TOP_LEVEL)
    message(STATUS "hybridgv: compiled without optimization (Debug); the solvers will be many times slower than in a Release build")
  endif()
endfunction()
