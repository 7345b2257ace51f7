# Debian packages: sh .ci/make_packages.sh, which calls cpack -G DEB in the folder of a Release build with CMAKE_INSTALL_PREFIX=/usr.
#
#   libhybridgv0.1    the shared library
#   libhybridgv-dev   headers, CMake and pkg-config files; needs Eigen, and OpenGV's headers for the bridge
#   libhybridgv-colmap0.1   the shared library that reads COLMAP's databases, where SQLite is found
#   hybridgv          the program with its man pages and completion, where CLI11 and nlohmann_json are found
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hybridgv)
set(CPACK_PACKAGE_VENDOR "HybridGV developers")
set(CPACK_PACKAGE_CONTACT "HybridGV developers <maintainers@hybridgv.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/PackageTools.cmake)

set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)  # of the same version
# What dpkg-shlibdeps makes of programs that use the library: libhybridgv0.1 (>= the version they were built with).
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)
if(HYBRIDGV_WITH_COLMAP)
  list(APPEND CPACK_COMPONENTS_ALL colmap)
  list(APPEND CPACK_COMPONENT_DEVELOPMENT_DEPENDS colmap)
  set(CPACK_COMPONENT_COLMAP_DEPENDS runtime)
  set(CPACK_COMPONENT_PROGRAM_DEPENDS colmap)
endif()
if(HYBRIDGV_WITH_PROGRAM)
  list(APPEND CPACK_COMPONENTS_ALL program)
  list(APPEND CPACK_COMPONENT_PROGRAM_DEPENDS runtime)
endif()

set(soname_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libhybridgv${soname_version})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COLMAP_PACKAGE_NAME libhybridgv-colmap${soname_version})
set(CPACK_DEBIAN_COLMAP_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_COLMAP_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COLMAP_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME hybridgv)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The packages of one build, in which dpkg-shlibdeps finds their libraries.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src ${PROJECT_BINARY_DIR}/adapters/colmap)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhybridgv-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.3), libopengv-dev")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Shared library.")
set(CPACK_COMPONENT_COLMAP_DESCRIPTION "Reader of COLMAP's databases.")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program hybridgv: registers images of a COLMAP database in a map.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, CMake and pkg-config files; the bridge to OpenGV is in the headers.")
include(CPack)
