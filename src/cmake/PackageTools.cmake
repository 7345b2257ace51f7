# Read by cpack: without these programs it would fail late, or silently make packages that depend on nothing.
foreach(tool file dpkg-shlibdeps)
  find_program(HYBRIDGV_PACKAGE_TOOL_${tool} ${tool})
  if(NOT HYBRIDGV_PACKAGE_TOOL_${tool})
    message(FATAL_ERROR "cpack needs the program ${tool}; Debian packages: file, dpkg-dev")
  endif()
endforeach()
