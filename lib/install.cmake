# Says where `cmake --install` puts headers, library, CMake package and pkg-config files. All of it can be moved as a whole. There
# are two components: one for programs to run, one for programs to be built.
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

# A C program that links the static library has to link what the C++ compiler would add.
set(static_libraries ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER static_libraries INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|c\\+\\+abi|m)$")
list(REMOVE_DUPLICATES static_libraries)
list(TRANSFORM static_libraries PREPEND -l)
list(JOIN static_libraries " " static_libraries)
configure_file(supernormal.pc.in ${PROJECT_BINARY_DIR}/supernormal.pc @ONLY)
configure_file(supernormal-cpp.pc.in ${PROJECT_BINARY_DIR}/supernormal-cpp.pc @ONLY)

install(
  TARGETS supernormal
  EXPORT supernormalTargets
  RUNTIME COMPONENT supernormal_runtime
  LIBRARY COMPONENT supernormal_runtime
          NAMELINK_COMPONENT supernormal_development
  ARCHIVE COMPONENT supernormal_development
  INCLUDES
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/include/supernormal
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT supernormal_development
  FILES_MATCHING
  PATTERN "*.h"
  PATTERN "*.hpp")
install(
  EXPORT supernormalTargets
  NAMESPACE supernormal::
  DESTINATION ${package_dir}
  COMPONENT supernormal_development)
install(
  FILES ${PROJECT_BINARY_DIR}/supernormalConfig.cmake ${PROJECT_BINARY_DIR}/supernormalConfigVersion.cmake
  DESTINATION ${package_dir}
  COMPONENT supernormal_development)
install(
  FILES ${PROJECT_BINARY_DIR}/supernormal.pc ${PROJECT_BINARY_DIR}/supernormal-cpp.pc
  DESTINATION ${pkgconfig_dir}
  COMPONENT supernormal_development)
# The licence goes with the library's code, wherever that is.
if(BUILD_SHARED_LIBS)
  set(licence_component supernormal_runtime)
else()
  set(licence_component supernormal_development)
endif()
install(
  FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT ${licence_component})
