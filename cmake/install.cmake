# SPDX-License-Identifier: MIT
# find_package(sateen) for outside projects. Shaders are embedded in the library, so that public headers, the library, its
# modules (src/io/modules) and these CMake files are all there is.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/sateen)

set_target_properties(sateen PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS sateen EXPORT sateenTargets COMPONENT development
  LIBRARY COMPONENT development ARCHIVE COMPONENT development RUNTIME COMPONENT development
  FILE_SET HEADERS COMPONENT development)
install(EXPORT sateenTargets NAMESPACE sateen:: DESTINATION ${package} COMPONENT development)

configure_package_config_file(cmake/sateenConfig.cmake.in sateenConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(sateenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sateenConfig.cmake ${PROJECT_BINARY_DIR}/sateenConfigVersion.cmake
  cmake/dependencies.cmake DESTINATION ${package} COMPONENT development)
