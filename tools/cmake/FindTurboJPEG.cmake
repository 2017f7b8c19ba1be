include(${CMAKE_CURRENT_LIST_DIR}/ImportedLibrary.cmake)
find_imported_library(TurboJPEG turbojpeg.h turbojpeg)
