# Finds OpenSubdiv's CPU library: target OpenSubdiv::osdCPU, variable OpenSubdiv_VERSION.
#
# Debian's own CMake files of OpenSubdiv name files that its packages do not have, hence this.
# OpenSubdiv_ROOT leads to another install.

find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/version.h)
find_library(OpenSubdiv_osdCPU_LIBRARY NAMES osdCPU)
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_osdCPU_LIBRARY)

if(OpenSubdiv_INCLUDE_DIR)
  file(STRINGS "${OpenSubdiv_INCLUDE_DIR}/opensubdiv/version.h" _osd_version
    REGEX "#define OPENSUBDIV_VERSION v[0-9_]+")
  string(REGEX REPLACE ".* v([0-9]+)_([0-9]+)_([0-9]+).*" "\\1.\\2.\\3"
    OpenSubdiv_VERSION "${_osd_version}")
  unset(_osd_version)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdiv
  REQUIRED_VARS OpenSubdiv_osdCPU_LIBRARY OpenSubdiv_INCLUDE_DIR
  VERSION_VAR OpenSubdiv_VERSION)

if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
  add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
  set_target_properties(OpenSubdiv::osdCPU PROPERTIES
    IMPORTED_LOCATION "${OpenSubdiv_osdCPU_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenSubdiv_INCLUDE_DIR}")
endif()
