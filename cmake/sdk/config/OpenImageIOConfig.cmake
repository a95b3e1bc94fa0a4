# OpenImageIO: the runtime's library, and headers of an earlier release of the same interface.

get_filename_component(_oiio_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(OpenImageIO_VERSION 3.0.9.1)
set(OpenImageIO_INCLUDE_DIRS "${_oiio_prefix}/include")

if(NOT TARGET OpenImageIO::OpenImageIO_Util)
  add_library(OpenImageIO::OpenImageIO_Util SHARED IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO_Util PROPERTIES
    IMPORTED_LOCATION "${_oiio_prefix}/lib/libOpenImageIO_Util.so"
    IMPORTED_SONAME libOpenImageIO_Util.so.3.0
    INTERFACE_INCLUDE_DIRECTORIES "${_oiio_prefix}/include"
    INTERFACE_COMPILE_FEATURES cxx_std_17)
endif()

if(NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO SHARED IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    IMPORTED_LOCATION "${_oiio_prefix}/lib/libOpenImageIO.so"
    IMPORTED_SONAME libOpenImageIO.so.3.0
    INTERFACE_INCLUDE_DIRECTORIES "${_oiio_prefix}/include"
    INTERFACE_COMPILE_FEATURES cxx_std_17
    INTERFACE_LINK_LIBRARIES OpenImageIO::OpenImageIO_Util
    # What the library itself needs lies beside the file that the link leads to, and it knows that.
    INTERFACE_LINK_OPTIONS "LINKER:--allow-shlib-undefined")
endif()

unset(_oiio_prefix)
set(OpenImageIO_FOUND TRUE)
