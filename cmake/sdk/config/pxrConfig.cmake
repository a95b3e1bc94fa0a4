# OpenUSD as tools/setup assembled it, under the names that a stock pxrConfig.cmake gives.
#
# The runtime is one monolithic library, so every library's target stands for the same file.

get_filename_component(_pxr_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(PXR_MAJOR_VERSION 0)
set(PXR_MINOR_VERSION 25)
set(PXR_PATCH_VERSION 8)
set(PXR_VERSION 2508)

set(PXR_CMAKE_DIR "${CMAKE_CURRENT_LIST_DIR}")
set(PXR_INCLUDE_DIRS "${_pxr_prefix}/include")
set(PXR_LIBRARIES usd_ms)

include(CMakeFindDependencyMacro)
find_dependency(TBB CONFIG)

if(NOT TARGET usd_ms)
  add_library(usd_ms SHARED IMPORTED)
  set_target_properties(usd_ms PROPERTIES
    IMPORTED_LOCATION "${_pxr_prefix}/lib/libusd_ms.so"
    INTERFACE_INCLUDE_DIRECTORIES "${PXR_INCLUDE_DIRS}"
    INTERFACE_COMPILE_FEATURES cxx_std_17
    INTERFACE_LINK_LIBRARIES TBB::tbb
    # TfHashMap is built on the compiler's old hash map, whose header says that it is deprecated.
    INTERFACE_COMPILE_OPTIONS "$<$<COMPILE_LANGUAGE:CXX>:-Wno-deprecated>"
    # The runtime wants a Python to be loaded already, and the linker should not look for it.
    INTERFACE_LINK_OPTIONS "LINKER:--allow-shlib-undefined")
endif()

foreach(_pxr_library
    arch tf gf js trace work plug vt ts
    ar kind sdf usd usdGeom usdLux usdShade usdRender usdUtils
    cameraUtil pxOsd hf hd usdImaging)
  if(NOT TARGET ${_pxr_library})
    add_library(${_pxr_library} INTERFACE IMPORTED)
    set_target_properties(${_pxr_library} PROPERTIES INTERFACE_LINK_LIBRARIES usd_ms)
  endif()
endforeach()

unset(_pxr_library)
unset(_pxr_prefix)
set(pxr_FOUND TRUE)
