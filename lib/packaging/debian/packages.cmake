# `cpack -G DEB` in the build folder makes Debian packages of what lib/packaging/install.cmake installs: for each of the two libraries one to run
# programs with, libsupernormal-core0 and libsupernormal0, and one to build them with, libsupernormal-core-dev and libsupernormal-dev.
# So the core is had without ODE. A static library is all in the second. Every other generator makes one package of everything.
set(CPACK_PACKAGE_NAME supernormal)
set(CPACK_PACKAGE_VENDOR Supernormal)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Collision detection of smooth convex bodies")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/for_generator.cmake)
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")  # which an archive without a prefix cannot hold
  set(CPACK_SET_DESTDIR ON)
endif()

set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Supernormal authors <supernormal@example.org>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL "")

# These are read by complete_packages.cmake, which adds to the staged files what only Debian asks for.
set(CPACK_SUPERNORMAL_COMPLETE_DEBIAN ${CMAKE_CURRENT_LIST_DIR}/complete_packages.cmake)
set(CPACK_SUPERNORMAL_SYMBOLS_DIR ${CMAKE_CURRENT_LIST_DIR})
set(CPACK_SUPERNORMAL_CONTROL_DIR ${PROJECT_BINARY_DIR}/debian)
set(CPACK_SUPERNORMAL_DOC_DIR ${CMAKE_INSTALL_DATAROOTDIR}/doc)
set(CPACK_SUPERNORMAL_LIB_DIR ${CMAKE_INSTALL_LIBDIR})

# supernormal_add_package(component package section description) makes one package of a component of lib/packaging/install.cmake.
macro(supernormal_add_package component package section description)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  # The summary precedes this text in a package's description.
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${description}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
endmacro()

# supernormal_add_runtime_package(component library description)
macro(supernormal_add_runtime_package component library description)
  supernormal_add_package(${component} ${library}${SUPERNORMAL_SOVERSION} libs "${description}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${CPACK_SUPERNORMAL_CONTROL_DIR}/${library}${SUPERNORMAL_SOVERSION}/symbols
                                                  ${CMAKE_CURRENT_LIST_DIR}/triggers)
endmacro()

set(about_core
    "Ellipsoids, superellipsoids, superovoids, any of them with rounded edges, and
bodies of your own: signed distance, common normal and witness points, contact
points, rays and mass, exact to the tolerance you ask for. No ODE is needed.")
set(about_ode
    "Ellipsoids, superellipsoids, superovoids, any of them with rounded edges, and
bodies of your own, as one geometry class of the Open Dynamics Engine, exact to
the tolerance you ask for.")

if(BUILD_SHARED_LIBS)
  # Besides the symbols files, for packages that are built without dpkg-gensymbols.
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
  # Here dpkg-shlibdeps finds the core, which is not yet a package when the ODE layer's package is made.
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
  supernormal_add_runtime_package(supernormal_core_runtime libsupernormal-core "${about_core}
This package holds the shared library of the core.")
endif()
supernormal_add_package(supernormal_core_development libsupernormal-core-dev libdevel "${about_core}
This package holds the core's headers, the CMake package and the pkg-config
file.")
set(CPACK_DEBIAN_SUPERNORMAL_CORE_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")

if(SUPERNORMAL_BUILD_ODE_LAYER)
  if(BUILD_SHARED_LIBS)
    supernormal_add_runtime_package(supernormal_runtime libsupernormal "${about_ode}
This package holds the shared library of the ODE layer.")
    set(CPACK_COMPONENT_SUPERNORMAL_RUNTIME_DEPENDS supernormal_core_runtime)
  endif()
  supernormal_add_package(supernormal_development libsupernormal-dev libdevel "${about_ode}
This package holds the headers of the ODE layer, its part of the CMake package
and its pkg-config files.")
  set(CPACK_DEBIAN_SUPERNORMAL_DEVELOPMENT_PACKAGE_DEPENDS "libode-dev (>= 2:0.16)")
  set(CPACK_COMPONENT_SUPERNORMAL_DEVELOPMENT_DEPENDS supernormal_core_development)
endif()
if(BUILD_SHARED_LIBS)
  set(CPACK_COMPONENT_SUPERNORMAL_CORE_DEVELOPMENT_DEPENDS supernormal_core_runtime)
  list(APPEND CPACK_COMPONENT_SUPERNORMAL_DEVELOPMENT_DEPENDS supernormal_runtime)
endif()
include(CPack)
