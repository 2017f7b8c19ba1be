# Finds volk.h, which the public headers include, and volk.c. Debian's libvulkan-volk-dev has no
# package file.
find_path(VolkSources_INCLUDE_DIR volk.c DOC "Folder with volk.h and volk.c")
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(VolkSources REQUIRED_VARS VolkSources_INCLUDE_DIR)
mark_as_advanced(VolkSources_INCLUDE_DIR)
if(VolkSources_FOUND AND NOT TARGET VolkSources::VolkSources)
  add_library(VolkSources::VolkSources INTERFACE IMPORTED)
  set_target_properties(VolkSources::VolkSources PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${VolkSources_INCLUDE_DIR})
endif()
