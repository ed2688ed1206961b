# Says where `cmake --install` puts headers, libraries, CMake package and pkg-config files. All of it can be moved as a whole, unless a
# folder was named by an absolute path. Each of the two libraries has two components: one for programs to run, one for programs to be
# built.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/supernormal)

# supernormal_at_install(component code): runs a function of at_install.cmake.
function(supernormal_at_install component code)
  install(
    CODE "set(SUPERNORMAL_LIBDIR [[${CMAKE_INSTALL_LIBDIR}]])
set(SUPERNORMAL_INCLUDEDIR [[${CMAKE_INSTALL_INCLUDEDIR}]])
set(SUPERNORMAL_ARCHITECTURE [[${CMAKE_LIBRARY_ARCHITECTURE}]])
include([[${PROJECT_SOURCE_DIR}/lib/packaging/at_install.cmake]])
${code}"
    COMPONENT ${component})
endfunction()

# supernormal_install_library(library component exports): the library, and the targets of the CMake package.
function(supernormal_install_library library component exports)
  install(
    TARGETS ${library}
    EXPORT ${exports}
    RUNTIME COMPONENT ${component}_runtime
    LIBRARY COMPONENT ${component}_runtime
            NAMELINK_COMPONENT ${component}_development
    ARCHIVE COMPONENT ${component}_development
    INCLUDES
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(
    EXPORT ${exports}
    NAMESPACE supernormal::
    DESTINATION ${package_dir}
    COMPONENT ${component}_development)
endfunction()

# supernormal_install_pkgconfig(component names...)
function(supernormal_install_pkgconfig component)
  foreach(name ${ARGN})
    configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
    supernormal_at_install(${component} "supernormal_install_pc([[${PROJECT_BINARY_DIR}/${name}.pc]] [[${BUILD_SHARED_LIBS}]])")
  endforeach()
endfunction()

set(static_definition "")
if(WIN32 AND NOT BUILD_SHARED_LIBS)
  set(static_definition -DSUPERNORMAL_STATIC)
endif()

# The core, and the CMake package, whose part for the ODE layer may be missing.
set_property(TARGET supernormal_core PROPERTY EXPORT_NAME core)
supernormal_install_library(supernormal_core supernormal_core supernormalCoreTargets)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/include/supernormal
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT supernormal_core_development
  FILES_MATCHING
  PATTERN "*.h"
  PATTERN "*.hpp"
  PATTERN supernormal.h EXCLUDE
  PATTERN effects.hpp EXCLUDE
  PATTERN geom.hpp EXCLUDE
  PATTERN stepper.hpp EXCLUDE)
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/supernormalConfig.cmake.in ${PROJECT_BINARY_DIR}/supernormalConfig.cmake
  INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/supernormalConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES ${PROJECT_BINARY_DIR}/supernormalConfig.cmake ${PROJECT_BINARY_DIR}/supernormalConfigVersion.cmake
  DESTINATION ${package_dir}
  COMPONENT supernormal_core_development)
supernormal_install_pkgconfig(supernormal_core_development supernormal-core)

# The licence goes with the core's code, without which the ODE layer is nowhere.
if(BUILD_SHARED_LIBS)
  set(licence_component supernormal_core_runtime)
else()
  set(licence_component supernormal_core_development)
endif()
install(
  FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT ${licence_component})

if(NOT SUPERNORMAL_BUILD_ODE_LAYER)
  return()
endif()

# The ODE layer finds the core beside itself, and ODE where it was linked.
if(APPLE)
  set(beside_itself @loader_path)
else()
  set(beside_itself $ORIGIN)
endif()
set_property(TARGET supernormal APPEND PROPERTY INSTALL_RPATH ${beside_itself})
set_property(TARGET supernormal PROPERTY INSTALL_RPATH_USE_LINK_PATH ON)
supernormal_install_library(supernormal supernormal supernormalTargets)
if(BUILD_SHARED_LIBS AND UNIX AND NOT APPLE)
  supernormal_at_install(supernormal_runtime "supernormal_settle_search_path([[$<TARGET_FILE_NAME:supernormal>]])")
endif()
install(
  FILES ${PROJECT_SOURCE_DIR}/include/supernormal/supernormal.h ${PROJECT_SOURCE_DIR}/include/supernormal/effects.hpp
        ${PROJECT_SOURCE_DIR}/include/supernormal/geom.hpp ${PROJECT_SOURCE_DIR}/include/supernormal/stepper.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/supernormal
  COMPONENT supernormal_development)
configure_file(${CMAKE_CURRENT_LIST_DIR}/supernormalOde.cmake.in ${PROJECT_BINARY_DIR}/supernormalOde.cmake @ONLY)
install(
  FILES ${PROJECT_BINARY_DIR}/supernormalOde.cmake ${PROJECT_SOURCE_DIR}/lib/packaging/supernormalFindOde.cmake
  DESTINATION ${package_dir}
  COMPONENT supernormal_development)

# A C program that links the static library has to link what the C++ compiler would add.
set(static_libraries "")
if(NOT BUILD_SHARED_LIBS)
  set(static_libraries ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
  list(FILTER static_libraries INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|c\\+\\+abi|m)$")
  list(REMOVE_DUPLICATES static_libraries)
  list(TRANSFORM static_libraries PREPEND -l)
  list(PREPEND static_libraries -lsupernormal-core)
  list(APPEND static_libraries ${CMAKE_THREAD_LIBS_INIT})
  list(JOIN static_libraries " " static_libraries)
endif()
supernormal_install_pkgconfig(supernormal_development supernormal supernormal-cpp)
