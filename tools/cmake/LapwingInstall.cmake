# Installs the libraries, their headers and a package file. find_package(lapwing) then defines the
# targets lapwing::core, lapwing::gpu, lapwing::vulkan and lapwing::render.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lapwing)
# Installs the public headers and all headers that they include. The other headers are internal.
set(public_headers
  lapwing/lapwing.h lapwing/base/cancellation.h lapwing/base/errors.h lapwing/base/limits.h
  lapwing/batch/batch.h lapwing/deform/deform_solver.h lapwing/deform/drag_preview.h
  lapwing/deform/drag_session.h lapwing/doctor/check.h lapwing/doctor/fix.h
  lapwing/doctor/format.h lapwing/kernels/cpu_kernels.h
  lapwing/mesh/shapes.h lapwing/mesh/transform.h lapwing/transplant/part_library.h
  lapwing/recipe/recipe.h lapwing/run/run_recipe.h lapwing/run/session.h)
if(LAPWING_VULKAN)
  list(APPEND public_headers
    lapwing/gpu/devices.h lapwing/render/render_image.h lapwing/render/surface.h
    lapwing/vulkan/open_device.h lapwing/vulkan/vulkan_kernels.h)
endif()
set(unread ${public_headers})
while(unread)
  list(POP_FRONT unread header)
  file(STRINGS ${PROJECT_SOURCE_DIR}/engine/${header} includes REGEX "^#include \"lapwing/")
  foreach(line ${includes})
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
    if(NOT included IN_LIST public_headers)
      list(APPEND public_headers ${included})
      list(APPEND unread ${included})
    endif()
  endforeach()
endwhile()
foreach(header ${public_headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/engine/${header}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
endforeach()
install(EXPORT lapwing FILE lapwingTargets.cmake NAMESPACE lapwing:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/tools/cmake/lapwingConfig.cmake.in
  ${PROJECT_BINARY_DIR}/lapwingConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lapwingConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/lapwingConfig.cmake ${PROJECT_BINARY_DIR}/lapwingConfigVersion.cmake
  tools/cmake/FindAMD.cmake tools/cmake/FindMETIS.cmake tools/cmake/FindTurboJPEG.cmake
  tools/cmake/FindVolkSources.cmake tools/cmake/ImportedLibrary.cmake
  DESTINATION ${package_dir})

# The linker options in lapwing.pc: all libraries and, for static libraries, their dependencies.
set(linked "-llapwing_core")
if(LAPWING_VULKAN)
  set(linked "-llapwing_render -llapwing_vulkan -llapwing_gpu ${linked}")
endif()
if(NOT BUILD_SHARED_LIBS)
  string(APPEND linked " -lturbojpeg -lamd -lmetis -pthread -ldl")
endif()
file(RELATIVE_PATH to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(tools/cmake/lapwing.pc.in ${PROJECT_BINARY_DIR}/lapwing.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lapwing.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
