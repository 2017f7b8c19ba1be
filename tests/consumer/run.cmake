# Installs the build in BUILD_DIR under WORK_DIR, builds the consumer in SOURCE_DIR and the C++
# program of README against that copy, and runs them; README's on SCAN, where that was fetched. The
# program is also built with the options of pkg-config, if that is installed.
function(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}\n${out}")
  endif()
endfunction()
file(REMOVE_RECURSE ${WORK_DIR})
step(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/installed)

file(READ ${README} readme)
string(REGEX MATCH "```cpp\n(([^`])*)```" found "${readme}")
if(NOT found)
  message(FATAL_ERROR "${README} has no C++ program")
endif()
file(WRITE ${WORK_DIR}/readme_program.cpp "${CMAKE_MATCH_1}")

step(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
     -DCMAKE_PREFIX_PATH=${WORK_DIR}/installed -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
     -DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS}
     -DREADME_PROGRAM=${WORK_DIR}/readme_program.cpp)
step(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
step(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${WORK_DIR}/build/consumer)
if(EXISTS ${SCAN})
  step(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${WORK_DIR}/build/readme_program ${SCAN})
endif()

find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG AND NOT CXX_FLAGS MATCHES "sanitize")
  file(GLOB_RECURSE package ${WORK_DIR}/installed/lapwing.pc)
  cmake_path(GET package PARENT_PATH folder)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder}
    ${PKG_CONFIG} --cflags --libs lapwing OUTPUT_VARIABLE options COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(options UNIX_COMMAND "${options}")
  # Without -march=native, since Eigen, here no system header, would warn of its own AVX code.
  step(c++ -std=c++20 -Wall -Wextra -Werror -o ${WORK_DIR}/by_pkg_config
       ${WORK_DIR}/readme_program.cpp ${options})
endif()
