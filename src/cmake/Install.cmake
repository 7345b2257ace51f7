include(CMakePackageConfigHelpers)

# Component runtime: what a program needs to run; development: what it needs to be built; colmap: the library that needs SQLite;
# program: the program hybridgv; python: the Python module.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hybridgv)
install(TARGETS hybridgv EXPORT hybridgvTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(EXPORT hybridgvTargets NAMESPACE hybridgv:: DESTINATION ${package_dir} COMPONENT development)
export(EXPORT hybridgvTargets NAMESPACE hybridgv:: FILE ${PROJECT_BINARY_DIR}/hybridgvTargets.cmake)
# Outside of the system's folders, what is installed finds its libraries beside itself, wherever the prefix is moved.
function(hybridgv_find_libraries_at target folder)
  if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN${folder}")
  endif()
endfunction()
set(colmap_headers "")
if(HYBRIDGV_WITH_COLMAP)
  install(TARGETS hybridgv_colmap EXPORT hybridgvColmapTargets
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT colmap NAMELINK_COMPONENT development
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT colmap)
  install(EXPORT hybridgvColmapTargets NAMESPACE hybridgv:: DESTINATION ${package_dir} COMPONENT development)
  export(EXPORT hybridgvColmapTargets NAMESPACE hybridgv:: FILE ${PROJECT_BINARY_DIR}/hybridgvColmapTargets.cmake)
  hybridgv_find_libraries_at(hybridgv_colmap "")
  set(colmap_headers ${PROJECT_SOURCE_DIR}/adapters/colmap/include)
endif()
if(HYBRIDGV_WITH_PROGRAM)
  install(TARGETS hybridgv_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  file(RELATIVE_PATH libraries_from_programs /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  hybridgv_find_libraries_at(hybridgv_program "/${libraries_from_programs}")
  install(FILES ${HYBRIDGV_DEFAULT_MAP_DIR}/cameras.txt ${HYBRIDGV_DEFAULT_MAP_DIR}/images.txt ${HYBRIDGV_DEFAULT_MAP_DIR}/points3D.txt
          DESTINATION ${CMAKE_INSTALL_DATADIR}/hybridgv/default_map COMPONENT program)
  install(FILES ${PROJECT_SOURCE_DIR}/src/program/completion/hybridgv
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  if(HYBRIDGV_MAN_PAGES)
    install(FILES ${HYBRIDGV_MAN_PAGES} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  endif()
endif()
if(HYBRIDGV_WITH_PYTHON)
  set(python_package_dir ${HYBRIDGV_PYTHON_DIR}/hybridgv)
  install(TARGETS hybridgv_python LIBRARY DESTINATION ${python_package_dir} COMPONENT python)
  install(FILES ${HYBRIDGV_PYTHON_FILES} DESTINATION ${python_package_dir} COMPONENT python)
  file(RELATIVE_PATH libraries_from_python /${python_package_dir} /${CMAKE_INSTALL_LIBDIR})
  hybridgv_find_libraries_at(hybridgv_python "/${libraries_from_python}")
endif()
foreach(root ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/adapters/arrays/include
             ${PROJECT_SOURCE_DIR}/adapters/opengv/include ${PROJECT_SOURCE_DIR}/adapters/report/include ${PROJECT_SOURCE_DIR}/adapters/sfm/include
             ${colmap_headers} ${PROJECT_BINARY_DIR}/include)
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
if(HYBRIDGV_WITH_COLMAP)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/hybridgv_colmap.pc.in ${PROJECT_BINARY_DIR}/hybridgv_colmap.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/hybridgv_colmap.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()
install(FILES ${PROJECT_BINARY_DIR}/hybridgv.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
