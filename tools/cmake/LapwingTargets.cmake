# How every target of the project is compiled: language level, warnings, sanitizers.

# The repository's own code is compiled under these warnings; dependencies come in as system headers.
add_library(lapwing_warnings INTERFACE)
# g++ 12 warns of overlaps and overflows inside std::string where there are none (GCC bug 105651),
# and of unset numbers in Eigen's fixed-size decompositions, whose loops it does not follow;
# Vulkan's structures are given their type and filled in by name.
target_compile_options(lapwing_warnings INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wall -Wextra -Wshadow
  -Wconversion -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized
  -Wno-missing-field-initializers
  $<$<BOOL:${LAPWING_FOLDER_UNITS}>:-Wno-subobject-linkage>>)

# One rounding per operation on every platform: results do not hang on what the compiler fuses.
add_compile_options(-ffp-contract=off)
# Libraries share precompiled headers, which fit only code that is compiled the same way.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

add_library(lapwing_sanitizers INTERFACE)
if(LAPWING_SANITIZE)
  target_compile_options(lapwing_sanitizers INTERFACE
    -fsanitize=${LAPWING_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(lapwing_sanitizers INTERFACE -fsanitize=${LAPWING_SANITIZE})
endif()

# lapwing_add_sources(TARGET SOURCES...): sources of TARGET. With LAPWING_FOLDER_UNITS those of one
# folder, or of the folders that set LAPWING_UNIT to the same name, are one unit of compilation: what
# they include, and templates that several of them use, are compiled once. Their names must then
# differ across files, those in unnamed namespaces too. A source with compile options or definitions
# of its own stays a unit of its own.
function(lapwing_add_sources target)
  target_sources(${target} PRIVATE ${ARGN})
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${LAPWING_FOLDER_UNITS} UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(GET folder FILENAME unit)
    if(LAPWING_UNIT)
      set(unit ${LAPWING_UNIT})
    endif()
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${unit})
  endforeach()
endfunction()

# lapwing_add_library(NAME EXPORT_NAME): a static library of the engine, installed and exported as
# lapwing::EXPORT_NAME. The CMakeLists.txt of each folder adds its sources.
function(lapwing_add_library name export_name)
  add_library(${name} STATIC)
  add_library(lapwing::${export_name} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/engine>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${name} PRIVATE
    $<BUILD_INTERFACE:lapwing_warnings> $<BUILD_INTERFACE:lapwing_sanitizers>)
  set_target_properties(${name} PROPERTIES
    EXPORT_NAME ${export_name} CXX_EXTENSIONS OFF)
  install(TARGETS ${name} EXPORT lapwing ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

# lapwing_add_program(NAME SOURCES...): an executable of the project.
function(lapwing_add_program name)
  add_executable(${name})
  lapwing_add_sources(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE lapwing_warnings lapwing_sanitizers)
  if(LAPWING_SANITIZE MATCHES "address")
    target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tools/cmake/keep_modules_loaded.cpp)
    target_link_options(${name} PRIVATE -Wl,--export-dynamic-symbol=dlclose)
  endif()
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE OFF
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

# What nearly every file includes, compiled once per library or test program: Eigen alone costs
# more than most files of the engine.
set(lapwing_common_headers
  <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <filesystem> <functional> <memory> <span> <string>
  <vector>)
