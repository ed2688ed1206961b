# What `cmake --install` puts where: headers, library, CMake package, pkg-config file. All of it can be moved as a whole.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/supernormal)
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH prefix_from_pkgconfig ${CMAKE_INSTALL_PREFIX}/${pkgconfig_dir} ${CMAKE_INSTALL_PREFIX}/.)

configure_package_config_file(
  supernormalConfig.cmake.in ${PROJECT_BINARY_DIR}/supernormalConfig.cmake
  INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/supernormalConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(supernormal.pc.in ${PROJECT_BINARY_DIR}/supernormal.pc @ONLY)

install(
  TARGETS supernormal
  EXPORT supernormalTargets
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/include/supernormal
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING
  PATTERN "*.h"
  PATTERN "*.hpp")
install(
  EXPORT supernormalTargets
  NAMESPACE supernormal::
  DESTINATION ${package_dir})
install(FILES ${PROJECT_BINARY_DIR}/supernormalConfig.cmake ${PROJECT_BINARY_DIR}/supernormalConfigVersion.cmake DESTINATION ${package_dir})
install(FILES ${PROJECT_BINARY_DIR}/supernormal.pc DESTINATION ${pkgconfig_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
