include(${CMAKE_CURRENT_LIST_DIR}/ImportedLibrary.cmake)
find_imported_library(AMD amd.h amd PATH_SUFFIXES suitesparse)
