# oneTBB: the runtime's library and headers of the same version.

get_filename_component(_tbb_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(TBB_VERSION 2021.13.0)

if(NOT TARGET TBB::tbb)
  find_package(Threads REQUIRED)
  add_library(TBB::tbb SHARED IMPORTED)
  set_target_properties(TBB::tbb PROPERTIES
    IMPORTED_LOCATION "${_tbb_prefix}/lib/libtbb.so"
    IMPORTED_SONAME libtbb.so.12
    INTERFACE_INCLUDE_DIRECTORIES "${_tbb_prefix}/include"
    INTERFACE_LINK_LIBRARIES Threads::Threads)
endif()

set(TBB_IMPORTED_TARGETS TBB::tbb)
unset(_tbb_prefix)
set(TBB_FOUND TRUE)
