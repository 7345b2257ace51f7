# The bridge to OpenGV is header-only: it is compiled in the user's program, with the user's flags, and needs nothing but OpenGV's
# headers. OpenGV's library is linked all the same, because programs that hold their data in OpenGV's adapters call it. The target
# exists where OpenGV does.
if(TARGET opengv AND NOT TARGET hybridgv::opengv)
  get_target_property(hybridgv_opengv_headers opengv INTERFACE_INCLUDE_DIRECTORIES)
  add_library(hybridgv::opengv INTERFACE IMPORTED GLOBAL)
  set_target_properties(hybridgv::opengv PROPERTIES
    INTERFACE_LINK_LIBRARIES "hybridgv::hybridgv;opengv"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${hybridgv_opengv_headers}")
endif()
