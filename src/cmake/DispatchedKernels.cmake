# hybridgv_add_dispatched_kernels(target PREFIX) adds PREFIXSse2.cpp and, for x86-64, PREFIXAvx2.cpp and PREFIXAvx512.cpp, each compiled
# for its instruction set. Such files contain no Eigen type and nothing but functions of internal linkage and one table, so that no
# code for a newer processor is ever shared with the rest of the library. The table is chosen at run time (math/SimdLevel.hpp).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64" AND CMAKE_SIZEOF_VOID_P EQUAL 8 AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  set(HYBRIDGV_X86_KERNELS ON)
endif()

function(hybridgv_add_dispatched_kernels target prefix)
  set(optimization "-ffp-contract=fast;-fno-math-errno;-fno-trapping-math")
  target_sources(${target} PRIVATE ${prefix}Sse2.cpp)
  set_source_files_properties(${prefix}Sse2.cpp PROPERTIES COMPILE_OPTIONS "${optimization}")
  if(HYBRIDGV_X86_KERNELS)
    target_compile_definitions(${target} PRIVATE HYBRIDGV_X86_KERNELS)
    target_sources(${target} PRIVATE ${prefix}Avx2.cpp ${prefix}Avx512.cpp)
    set_source_files_properties(${prefix}Avx2.cpp PROPERTIES COMPILE_OPTIONS "${optimization};-mavx2;-mfma")
    set_source_files_properties(${prefix}Avx512.cpp PROPERTIES COMPILE_OPTIONS
      "${optimization};-mavx512f;-mavx512dq;-mavx512vl;-mavx2;-mfma;-mprefer-vector-width=512")
  endif()
endfunction()
