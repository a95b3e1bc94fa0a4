# OpenColorIO: the runtime's library and headers of the same version.

get_filename_component(_ocio_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(OpenColorIO_VERSION 2.4.2)

if(NOT TARGET OpenColorIO::OpenColorIO)
  add_library(OpenColorIO::OpenColorIO SHARED IMPORTED)
  set_target_properties(OpenColorIO::OpenColorIO PROPERTIES
    IMPORTED_LOCATION "${_ocio_prefix}/lib/libOpenColorIO.so"
    IMPORTED_SONAME libOpenColorIO.so.2.4
    INTERFACE_INCLUDE_DIRECTORIES "${_ocio_prefix}/include"
    INTERFACE_LINK_OPTIONS "LINKER:--allow-shlib-undefined")
endif()

unset(_ocio_prefix)
set(OpenColorIO_FOUND TRUE)
