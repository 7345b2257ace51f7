# Builds the project of this folder as a user would: against an installation in a temporary prefix, against the build tree, with
# pkg-config, and with the sources in a subdirectory (there only the headers: compiling the library again would take too long).
set(consumer_source ${CMAKE_CURRENT_SOURCE_DIR}/consumer)
set(consumer_build ${CMAKE_CURRENT_BINARY_DIR}/consumer)
set(consumer_prefix ${consumer_build}/prefix)
add_test(NAME consumer_install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${consumer_prefix})
set_tests_properties(consumer_install PROPERTIES FIXTURES_SETUP consumer_prefix)

function(hybridgv_consumer_test name targets)
  add_test(NAME consumer_${name}
           COMMAND sh ${consumer_source}/check.sh ${consumer_build}/${name} "${targets}" -G ${CMAKE_GENERATOR}
                   -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}" ${ARGN})
  set_tests_properties(consumer_${name} PROPERTIES FIXTURES_REQUIRED consumer_prefix)
endfunction()

set(same_compiler -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER})
set(installed -DCMAKE_PREFIX_PATH=${consumer_prefix})
hybridgv_consumer_test(without_opengv "headers core" ${same_compiler} ${installed} -DEXPECT_OPENGV=OFF
                       -DCMAKE_DISABLE_FIND_PACKAGE_opengv=ON)
if(HYBRIDGV_WITH_COLMAP)
  hybridgv_consumer_test(colmap colmap ${same_compiler} ${installed} -DEXPECT_OPENGV=OFF -DCMAKE_DISABLE_FIND_PACKAGE_opengv=ON)
endif()
# Asking for the bridge where there is no OpenGV is answered by the reason.
foreach(component opengv typo)
  add_test(NAME consumer_missing_${component}
           COMMAND ${CMAKE_COMMAND} -S ${consumer_source}/missing -B ${consumer_build}/missing_${component} -G ${CMAKE_GENERATOR}
                   ${same_compiler} ${installed} -DCOMPONENT=${component} -DCMAKE_DISABLE_FIND_PACKAGE_opengv=ON)
  set_tests_properties(consumer_missing_${component} PROPERTIES FIXTURES_REQUIRED consumer_prefix)
endforeach()
set_tests_properties(consumer_missing_opengv PROPERTIES PASS_REGULAR_EXPRESSION "libopengv-dev")
set_tests_properties(consumer_missing_typo PROPERTIES PASS_REGULAR_EXPRESSION "no component typo")
add_test(NAME consumer_installs_own_files_only
         COMMAND sh ${consumer_source}/installs_own_files_only.sh ${consumer_build}/own ${PROJECT_SOURCE_DIR} -G ${CMAKE_GENERATOR}
                 ${same_compiler} -DCMAKE_BUILD_TYPE= -DEXPECT_OPENGV=OFF -DCMAKE_DISABLE_FIND_PACKAGE_opengv=ON)
if(TARGET opengv)
  hybridgv_consumer_test(opengv "headers loops" ${same_compiler} ${installed})
  hybridgv_consumer_test(readme readme ${same_compiler} ${installed})
  hybridgv_consumer_test(build_tree core ${same_compiler} -Dhybridgv_DIR=${PROJECT_BINARY_DIR})
  hybridgv_consumer_test(subdirectory headers ${same_compiler} -DHYBRIDGV_SOURCE_DIR=${PROJECT_SOURCE_DIR})
  hybridgv_consumer_test(fetch_content own ${same_compiler} -DHYBRIDGV_SOURCE_DIR=${PROJECT_SOURCE_DIR} -DFETCH_CONTENT=ON)
  # A program for the newest instruction set of this machine works with the library for all machines.
  hybridgv_consumer_test(native loops ${same_compiler} ${installed} "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS} -O2 -march=native")
  find_program(HYBRIDGV_CLANG clang++)
  mark_as_advanced(HYBRIDGV_CLANG)
  if(HYBRIDGV_CLANG AND NOT CMAKE_CXX_FLAGS MATCHES -fsanitize)
    hybridgv_consumer_test(clang "headers loops" -DCMAKE_CXX_COMPILER=${HYBRIDGV_CLANG} ${installed})
  endif()
endif()

find_program(HYBRIDGV_PKG_CONFIG pkg-config)
mark_as_advanced(HYBRIDGV_PKG_CONFIG)
if(HYBRIDGV_PKG_CONFIG)
  separate_arguments(consumer_flags UNIX_COMMAND "${CMAKE_CXX_FLAGS}")
  add_test(NAME consumer_pkg_config COMMAND sh ${consumer_source}/pkg_config.sh ${consumer_build}/pkg_config ${consumer_prefix}
                                            ${CMAKE_INSTALL_LIBDIR} ${CMAKE_CXX_COMPILER} ${consumer_flags})
  set_tests_properties(consumer_pkg_config PROPERTIES FIXTURES_REQUIRED consumer_prefix)
  add_library(hybridgv_archive STATIC $<TARGET_OBJECTS:hybridgv_objects>)
  set_target_properties(hybridgv_archive PROPERTIES LINKER_LANGUAGE CXX)
  add_test(NAME consumer_pkg_config_static
           COMMAND sh ${consumer_source}/pkg_config_static.sh ${consumer_build}/pkg_config_static ${consumer_prefix}
                   ${CMAKE_INSTALL_LIBDIR} $<TARGET_FILE:hybridgv_archive> ${CMAKE_CXX_COMPILER} ${consumer_flags})
  set_tests_properties(consumer_pkg_config_static PROPERTIES FIXTURES_REQUIRED consumer_prefix)
endif()
