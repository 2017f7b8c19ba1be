# The common settings of all targets: language level, warnings, sanitizers.

# The warnings for the project's code; dependencies are system headers.
add_library(lapwing_warnings INTERFACE)
# g++ 12 wrongly warns of overlaps and overflows inside std::string (GCC bug 105651), and of
# uninitialized values in Eigen's fixed-size decompositions. Vulkan's structures are initialized by
# member name, so missing initializers are intended.
target_compile_options(lapwing_warnings INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wall -Wextra -Wshadow
  -Wconversion -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized
  -Wno-missing-field-initializers
  $<$<BOOL:${LAPWING_FOLDER_UNITS}>:-Wno-subobject-linkage>>
  $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-missing-field-initializers>)

# Do not fuse multiplications and additions, so that results do not depend on the compiler's choice.
add_compile_options(-ffp-contract=off)
# The libraries share precompiled headers, which require the same compile options everywhere.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

add_library(lapwing_sanitizers INTERFACE)
if(LAPWING_SANITIZE)
  target_compile_options(lapwing_sanitizers INTERFACE
    -fsanitize=${LAPWING_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # Loops with checks cannot be unrolled, and Clang would warn about this in each kernel.
    $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-pass-failed>)
  target_link_options(lapwing_sanitizers INTERFACE -fsanitize=${LAPWING_SANITIZE})
endif()

# lapwing_add_sources(TARGET SOURCES...): adds sources to TARGET. With LAPWING_FOLDER_UNITS, the
# sources of one folder, or of the folders that set LAPWING_UNIT to the same name, form one
# translation unit, so that headers and templates are compiled once. Names must then differ between
# files, even in unnamed namespaces. A source with separate compile options or definitions remains a
# separate unit.
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

# lapwing_add_library(NAME EXPORT_NAME): a library of the engine, static unless BUILD_SHARED_LIBS,
# installed and exported as lapwing::EXPORT_NAME. The CMakeLists.txt of each folder adds its sources.
function(lapwing_add_library name export_name)
  add_library(${name})
  add_library(lapwing::${export_name} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/engine>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${name} PRIVATE
    $<BUILD_INTERFACE:lapwing_warnings> $<BUILD_INTERFACE:lapwing_sanitizers>)
  # The libraries share precompiled headers, so their compile definitions must be the same.
  set_target_properties(${name} PROPERTIES
    EXPORT_NAME ${export_name} CXX_EXTENSIONS OFF DEFINE_SYMBOL "" INSTALL_RPATH "\$ORIGIN"
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if(LAPWING_INSTALL)
    install(TARGETS ${name} EXPORT lapwing
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endif()
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
    INSTALL_RPATH "\$ORIGIN/../${CMAKE_INSTALL_LIBDIR}"
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

# Headers that nearly every file includes. They are precompiled once per library or test program.
set(lapwing_common_headers
  <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <filesystem> <functional> <memory> <span> <string>
  <vector>)

# lapwing_leave_out_of_sanitized_builds(TARGET): a build with sanitizers makes TARGET only if it is
# named, because the tests of CI do not run it there.
function(lapwing_leave_out_of_sanitized_builds target)
  if(LAPWING_SANITIZE)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endfunction()
