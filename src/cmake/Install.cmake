include(CMakePackageConfigHelpers)

# Component runtime: what a program needs to run; development: what it needs to be built.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hybridgv)
install(TARGETS hybridgv EXPORT hybridgvTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(EXPORT hybridgvTargets NAMESPACE hybridgv:: DESTINATION ${package_dir} COMPONENT development)
export(EXPORT hybridgvTargets NAMESPACE hybridgv:: FILE ${PROJECT_BINARY_DIR}/hybridgvTargets.cmake)
foreach(root ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/adapters/arrays/include
             ${PROJECT_SOURCE_DIR}/adapters/opengv/include ${PROJECT_SOURCE_DIR}/adapters/sfm/include
             ${PROJECT_BINARY_DIR}/include)
  install(DIRECTORY ${root}/hybridgv DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hybridgvConfig.cmake.in ${PROJECT_BINARY_DIR}/hybridgvConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hybridgvConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hybridgvConfig.cmake ${PROJECT_BINARY_DIR}/hybridgvConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/hybridgvFindOpenGV.cmake ${CMAKE_CURRENT_LIST_DIR}/hybridgvOpenGV.cmake DESTINATION ${package_dir}
        COMPONENT development)
foreach(file hybridgvFindOpenGV hybridgvOpenGV)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${file}.cmake ${PROJECT_BINARY_DIR}/${file}.cmake COPYONLY)
endforeach()
# The installed package can be moved: its prefix is found from the place of its .pc file.
string(REGEX REPLACE "[^/]+" ".." prefix_from_pc ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
get_target_property(library_type hybridgv TYPE)
if(library_type STREQUAL "STATIC_LIBRARY")
  set(definitions_of_pc " -DHYBRIDGV_STATIC")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/hybridgv.pc.in ${PROJECT_BINARY_DIR}/hybridgv.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/hybridgv.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
