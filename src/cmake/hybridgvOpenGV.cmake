# The bridge to OpenGV is header-only: it is compiled in the user's program, with the user's flags, and takes from OpenGV
# nothing but its headers. The target exists where the package opengv was found.
if(opengv_FOUND AND NOT TARGET hybridgv::opengv)
  get_target_property(hybridgv_opengv_headers opengv INTERFACE_INCLUDE_DIRECTORIES)
  add_library(hybridgv::opengv INTERFACE IMPORTED GLOBAL)
  set_target_properties(hybridgv::opengv PROPERTIES
    INTERFACE_LINK_LIBRARIES hybridgv::hybridgv
    INTERFACE_INCLUDE_DIRECTORIES "${hybridgv_opengv_headers}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${hybridgv_opengv_headers}")
endif()
