# Finds OpenGV for the bridge, unless the project that uses this one brings a target `opengv` of its own. The target is made
# visible wherever hybridgv::opengv is, which links it.
if(NOT TARGET opengv)
  find_package(opengv QUIET CONFIG)
  if(TARGET opengv)
    set_target_properties(opengv PROPERTIES IMPORTED_GLOBAL ON)
  endif()
endif()
