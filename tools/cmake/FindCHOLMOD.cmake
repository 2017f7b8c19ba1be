include(${CMAKE_CURRENT_LIST_DIR}/ImportedLibrary.cmake)
find_imported_library(CHOLMOD cholmod.h cholmod PATH_SUFFIXES suitesparse)
