# hybridgv_add_dispatched_kernels(target HEADER) compiles HEADER, which defines a table of functions (math/simd/versions.hpp), once
# per instruction set: in files that are written into the build folder, each with HYBRIDGV_INSTRUCTION_SET and the compiler's flags
# for the set. Such a header contains no Eigen type, and everything in it lives in namespaces of the instruction set's name, so
# that no code for a newer processor is ever shared with the rest of the library. The table is chosen at run time
# (math/simd/SimdLevel.hpp).
#
# Other processors than x86-64 have the baseline alone. An object of macOS may be for several processors: then the flags are for
# the x86-64 part, and the files of the newer instruction sets are empty in the others.
set(HYBRIDGV_KERNEL_FLAGS -ffp-contract=fast -fno-math-errno -fno-trapping-math)
set(HYBRIDGV_AVX2_FLAGS -mavx2 -mfma)
set(HYBRIDGV_AVX512_FLAGS -mavx512f -mavx512dq -mavx512vl -mavx2 -mfma -mprefer-vector-width=512)

set(HYBRIDGV_INSTRUCTION_SETS baseline)
list(LENGTH CMAKE_OSX_ARCHITECTURES architectures)
if(architectures GREATER 1)
  list(APPEND HYBRIDGV_INSTRUCTION_SETS avx2 avx512)
  list(TRANSFORM HYBRIDGV_AVX2_FLAGS PREPEND "-Xarch_x86_64;")
  list(TRANSFORM HYBRIDGV_AVX512_FLAGS PREPEND "-Xarch_x86_64;")
else()
  include(CheckCXXSourceCompiles)
  check_cxx_source_compiles("
    #if !defined(__x86_64__)
    #error
    #endif
    int main() {}" HYBRIDGV_IS_X86_64)
  if(HYBRIDGV_IS_X86_64)
    list(APPEND HYBRIDGV_INSTRUCTION_SETS avx2 avx512)
  endif()
endif()

function(hybridgv_add_dispatched_kernels target header)
  string(REGEX REPLACE "\\.hpp$" "" stem ${header})
  foreach(set ${HYBRIDGV_INSTRUCTION_SETS})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${stem}.${set}.cpp)
    set(text "#define HYBRIDGV_INSTRUCTION_SET ${set}\n#include \"${header}\"\n")
    if(NOT set STREQUAL baseline)
      set(text "#if defined(__x86_64__)\n${text}#endif\n")
    endif()
    file(GENERATE OUTPUT ${source} CONTENT "${text}")
    string(TOUPPER ${set} name)
    target_sources(${target} PRIVATE ${source})
    set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS "${HYBRIDGV_KERNEL_FLAGS};${HYBRIDGV_${name}_FLAGS}")
  endforeach()
endfunction()
