# Installs the libraries, their headers and a package file: find_package(lapwing) then gives
# lapwing::core, lapwing::gpu, lapwing::vulkan and lapwing::render.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lapwing)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/engine/lapwing DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h"
        # With JSON in them, which stays inside.
        PATTERN "recipe/*write*.h" EXCLUDE PATTERN "*_json.h" EXCLUDE)
install(EXPORT lapwing FILE lapwingTargets.cmake NAMESPACE lapwing:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/tools/cmake/lapwingConfig.cmake.in
  ${PROJECT_BINARY_DIR}/lapwingConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lapwingConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/lapwingConfig.cmake ${PROJECT_BINARY_DIR}/lapwingConfigVersion.cmake
  tools/cmake/FindAMD.cmake tools/cmake/FindMETIS.cmake
  tools/cmake/FindTurboJPEG.cmake
  DESTINATION ${package_dir})
